#include "pipeline/job/cluster.h"

#include "pipeline/settings/document.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, Cluster& cluster) {
  f.text("name", cluster.name, Need::required, "name");
  f.text("source", cluster.source, Need::required, "where the words and limits come from");
  f.text(
      "launcher", cluster.launcher, Need::required,
      "shell words before each stage's command, which start it in the allocation and end with its exit status");
  f.text("submit", cluster.submit, Need::optional,
         "shell words that queue a batch script of Slurm's kind and print its number alone");
  f.text("options", cluster.options, Need::optional,
         "more options of the queue, as in `--partition=long --time=24:00:00`");
  f.integer("tasks", cluster.tasks, Need::optional, between(1, 1024),
            "stages at a time in an allocation, a core each");
  f.number("memory_MB", cluster.memory, Need::optional, between(64, 1e7),
           "of each of them; no stage may take more");
  f.integer("most_stages", cluster.most_stages, Need::optional, between(3, 1e9),
            "that one allocation can start; a study with more becomes an array of them");
}

Cluster read_cluster(const std::filesystem::path& file) {
  Cluster cluster;
  const Node document = read_yaml(file);
  if (!document.is_map())
    throw InputError({file.string()}, "holds no cluster", "write name:, source: and launcher:");
  read_fields(document, cluster);
  for (const char* key : {"launcher", "submit", "options"})
    if (const Node* words = document.find(key); words && words->text.find('\n') != std::string::npos)
      throw InputError(words->where, std::string(key) + " has several lines", "write them in one");
  return cluster;
}

}  // namespace dresslife::pipeline
