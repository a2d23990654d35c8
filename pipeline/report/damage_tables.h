// Where a job's damage comes from, as sections of a page: along the dresspack and by the nearest clamp, by
// program line, joint and layer of wires.
#pragma once

#include <string>

#include "pipeline/report/life_charts.h"
#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// The ways in which the dresspack fails: lives, place and moment of each, with its legend. Empty: only the wires are known.
std::string failure_table(const RankingRow& row);

/// A chart below its heading and a remark; empty without a chart.
std::string chart_section(const std::string& heading, const std::string& remark, const std::string& chart);

/// Along the dresspack with the worst wire, and by clamp.
std::string damage_along(const LifeSummary& life, const RankingRow& row);

/// Of the worst wire by program line and by joint, and the life of each layer of wires.
std::string damage_tables(const LifeSummary& life, const RankingRow& row);

}  // namespace dresslife::pipeline
