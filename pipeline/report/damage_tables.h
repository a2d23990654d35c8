// Sections of a page with the damage of a job: along the dresspack and by the nearest clamp, by program line, by joint and by
// layer of wires.
#pragma once

#include <string>

#include "pipeline/report/life_charts.h"
#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Returns the failure modes of the dresspack: lives, place and time of each, with a legend. Empty: only the wires have a life.
std::string failure_table(const RankingRow& row);

/// Returns a chart with a heading and a remark; empty without a chart.
std::string chart_section(const std::string& heading, const std::string& remark, const std::string& chart);

/// Returns the damage along the dresspack with the worst wire, and by clamp.
std::string damage_along(const LifeSummary& life, const RankingRow& row);

/// Returns the damage of the worst wire by program line and by joint, and the life of each layer of wires.
std::string damage_tables(const LifeSummary& life, const RankingRow& row);

}  // namespace dresslife::pipeline
