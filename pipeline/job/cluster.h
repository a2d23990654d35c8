// A cluster's queue, and how a run starts its stages inside of an allocation.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

class Fields;

struct Cluster {
  std::string name, source;
  std::string submit = "sbatch";  ///< shell words that queue a batch script and print its number
  std::string options;            ///< options of the queue for everything that is submitted
  std::string launcher;           ///< shell words before each stage's command
  int tasks = 16;                 ///< stages at the same time
  double memory = 2e9;            ///< memory of each stage [byte]
  int most_stages = 40000;        ///< limit of stages in one allocation
};

void describe(Fields& f, Cluster& cluster);

/// Reads a cluster from a file. Errors: InputError at the wrong key.
Cluster read_cluster(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
