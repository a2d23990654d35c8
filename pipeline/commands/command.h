// The commands of dresslife: each tells the command line its words and does its work in a file of its own.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace dresslife::pipeline {

struct Command {
  CLI::App* words;           ///< parsed() when it is the one that was called
  std::function<int()> act;  ///< returns the exit status. Errors: InputError
};

// Studies
Command add_run(CLI::App& program);
Command add_submit(CLI::App& program);
Command add_status(CLI::App& program);
Command add_report(CLI::App& program);
Command add_clean(CLI::App& program);
Command add_improve(CLI::App& program);
Command add_reprogram(CLI::App& program);
// Cables and the tests that they are put to
Command add_rate(CLI::App& program);
Command add_validate(CLI::App& program);
Command add_calibrate(CLI::App& program);
// One job, one dresspack
Command add_show(CLI::App& program);
Command add_preview(CLI::App& program);
Command add_route(CLI::App& program);
Command add_draw(CLI::App& program);
Command add_page(CLI::App& program);
Command add_plot(CLI::App& program);
Command add_export(CLI::App& program);
// About the program itself
Command add_manual(CLI::App& program);

}  // namespace dresslife::pipeline
