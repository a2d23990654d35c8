#include "pipeline/job/cluster.h"

#include "pipeline/settings/document.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, Cluster& cluster) {
  f.text("name", cluster.name, Need::required, "The name of the cluster.");
  f.text("source", cluster.source, Need::required, "The source of the commands and limits.");
  f.text("launcher", cluster.launcher, Need::required,
         "The shell words before the command of each stage. They start the stage in the allocation and end "
         "with its exit status.");
  f.text("submit", cluster.submit, Need::optional,
         "The shell words that queue a batch script in Slurm's format and print its number alone.");
  f.text("options", cluster.options, Need::optional,
         "Further options of the queue, as in `--partition=long --time=24:00:00`.");
  f.integer("tasks", cluster.tasks, Need::optional, between(1, 1024),
            "The number of stages that run at a time in an allocation, one core each.");
  f.number("memory_MB", cluster.memory, Need::optional, between(64, 1e7),
           "The memory of each stage. No stage may use more.");
  f.integer("most_stages", cluster.most_stages, Need::optional, between(3, 1e9),
            "The number of stages that one allocation can start. A larger study becomes an array of "
            "allocations.");
}

Cluster read_cluster(const std::filesystem::path& file) {
  Cluster cluster;
  const Node document = read_yaml(file);
  if (!document.is_map()) throw InputError({file.string()}, "holds no cluster", "write name:, source: and launcher:");
  read_fields(document, cluster);
  for (const char* key : {"launcher", "submit", "options"})
    if (const Node* words = document.find(key); words && words->text.find('\n') != std::string::npos)
      throw InputError(words->where, std::string(key) + " has several lines", "write them in one");
  return cluster;
}

}  // namespace dresslife::pipeline
