// A progress line on a terminal; silent when standard error is not one.
#pragma once

#include <string>

namespace dresslife::pipeline {

class Progress {
 public:
  Progress(std::string label, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double share);              ///< of the work done, 0..1
  void show(const std::string& words);  ///< instead of a share
  void note(const std::string& line);   ///< a lasting line; also where there is no terminal, unless quiet
  void clear();

 private:
  void draw(const std::string& words);
  std::string label_;
  bool quiet_, terminal_;
  int last_permille_ = -1;
  bool drawn_ = false;
};

}  // namespace dresslife::pipeline
