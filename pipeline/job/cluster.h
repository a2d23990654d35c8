// A cluster's queue, and how a run starts its stages in what the queue gives it.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

class Fields;

struct Cluster {
  std::string name, source;
  std::string submit = "sbatch";  ///< shell words that queue a batch script and print its number
  std::string options;            ///< more words of the queue, for all that is submitted
  std::string launcher;           ///< shell words before each stage's command
  int tasks = 16;                 ///< stages at a time
  double memory = 2e9;            ///< of each [byte]
  int most_stages = 40000;        ///< that one allocation may start
};

void describe(Fields& f, Cluster& cluster);

/// Errors: InputError at the key that is wrong.
Cluster read_cluster(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
