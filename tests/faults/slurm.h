// A private Slurm of one node on loopback. Its daemons are child processes of the test and end with it. It has no systemd,
// cgroups or accounting. A Slurm that is installed on the machine is not changed.
#pragma once

#include <fmt/format.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/process.h"

namespace dresslife::tests {

/// Returns whether `comes_true` returns true within this time. The times only limit an endless wait. They are far longer
/// than a busy machine needs.
inline bool within(int seconds, const std::function<bool()>& comes_true) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  while (!comes_true()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return true;
}

/// A process below this one (child, grandchild, ...) and its name.
struct Process {
  pid_t id;
  std::string name;
};
inline std::vector<Process> all_below() {
  std::vector<Process> found{{::getpid(), ""}};
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::string folder = fmt::format("/proc/{0}/task/{0}/", found[k].id);
    std::ifstream children(folder + "children");
    for (pid_t child; children >> child;) {
      std::string name;
      std::getline(std::ifstream(fmt::format("/proc/{}/comm", child)) >> std::ws, name);
      found.push_back({child, name});
    }
  }
  found.erase(found.begin());
  return found;
}

class Slurm {
 public:
  /// Starts Slurm in the scratch folder. If it runs, why_not() is empty; otherwise why_not() is the reason.
  explicit Slurm(const Scratch& scratch) : scratch_(scratch), folder_(scratch / "slurm") {
    for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "srun"})
      if (run_shell(scratch, std::string("PATH=$PATH:/usr/sbin command -v ") + program).status != 0)
        why_not_ = std::string(program) + " is not installed (apt-get install munge slurmctld slurmd slurm-client)";
    if (why_not_.empty() && ::geteuid() != 0) why_not_ = "slurmd runs as root only";
    if (why_not_.empty()) begin();
  }
  ~Slurm() {
    if (begun_) end();
  }
  Slurm(const Slurm&) = delete;
  Slurm& operator=(const Slurm&) = delete;

  const std::string& why_not() const { return why_not_; }
  static int cpus() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }
  /// Runs a line of shell that can use Slurm's programs. The line must limit its own time.
  Outcome shell(const std::string& line) const {
    return run_shell(scratch_, "export SLURM_CONF='" + conf() + "'; " + line);
  }
  /// Returns state and exit code of a job: "PENDING", "COMPLETED 0:0", ... For an array job: the distinct lines of all its tasks.
  std::string state(const std::string& job) const {
    return shell("timeout 20 scontrol show job " + job +
                 " | sed -n 's/.*JobState=\\([A-Z_]*\\).*/\\1/p; s/.*ExitCode=\\([0-9:]*\\).*/\\1/p' | paste "
                 "-sd ' \\n' | sort -u")
        .out;
  }
  bool node_is(const std::string& word) const {
    return shell("timeout 20 sinfo -h -o %T").out.find(word) != std::string::npos;
  }
  bool set_node(const std::string& word) const {
    return shell("timeout 20 scontrol update NodeName=localhost Reason=test State=" + word).status == 0;
  }
  /// Returns whether no process of any job step is running.
  static bool no_steps() {
    bury();
    const std::vector<Process> all = all_below();
    return std::none_of(all.begin(), all.end(), [](const Process& one) { return one.name.starts_with("slurmstepd"); });
  }
  std::string logs() const {
    std::string text;
    for (const char* log : {"munged.log", "slurmctld.log", "slurmd.log"})
      text += fmt::format("== {}\n{}", log, run_shell(scratch_, fmt::format("tail -n 8 slurm/{}", log)).out);
    return text;
  }

 private:
  /// Reaps ended child processes. Otherwise all_below() would still find them.
  static void bury() {
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
  }

  std::string conf() const { return (folder_ / "slurm.conf").string(); }

  static int free_port() {
    const int end = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    const bool bound = ::bind(end, reinterpret_cast<sockaddr*>(&address), length) == 0 &&
                       ::getsockname(end, reinterpret_cast<sockaddr*>(&address), &length) == 0;
    ::close(end);
    return bound ? ntohs(address.sin_port) : 0;
  }

  void write_conf() const {
    fs::create_directories(folder_ / "state");
    fs::create_directories(folder_ / "spool");
    const std::string here = folder_.string();
    // cred_expire: a requeued job waits this time instead of two minutes. ReturnToService 1: a node that was set
    // down stays down until a command changes it.
    scratch_.write(
        "slurm/slurm.conf",
        fmt::format("ClusterName=test\nSlurmctldHost=localhost(127.0.0.1)\nSlurmUser=root\nSlurmdUser=root\n"
                    "AuthType=auth/munge\nAuthInfo=socket={0}/munge.socket,cred_expire=5\n"
                    "SlurmctldPort={1}\nSlurmdPort={2}\nStateSaveLocation={0}/state\nSlurmdSpoolDir={0}/spool\n"
                    "SlurmctldPidFile={0}/slurmctld.pid\nSlurmdPidFile={0}/slurmd.pid\nMailProg=/bin/true\n"
                    "ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nMpiDefault=none\n"
                    "JobAcctGatherType=jobacct_gather/none\nAccountingStorageType=accounting_storage/none\n"
                    "SelectType=select/cons_tres\nSelectTypeParameters=CR_Core_Memory\nReturnToService=1\n"
                    "KillWait=1\nSchedulerParameters=batch_sched_delay=0,sched_interval=1\n"
                    "NodeName=localhost NodeAddr=127.0.0.1 CPUs={3} RealMemory=1024 State=UNKNOWN\n"
                    "PartitionName=all Nodes=ALL Default=YES\n",
                    here, free_port(), free_port(), cpus()));
  }

  /// Starts a daemon as a child process, which ends with this process. The daemon's output goes into `log`.
  void start(const std::string& words, const std::string& log) {
    const pid_t child = ::fork();
    if (child != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const std::string line = "cd '" + folder_.string() + "' && export SLURM_CONF='" + conf() +
                             "' PATH=$PATH:/usr/sbin && exec " + words + " >>" + log + " 2>&1 </dev/null";
    ::execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }

  void begin() {
    begun_ = true;
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // this process adopts processes that the daemons leave, so end() can kill them
    write_conf();
    run_shell(scratch_, "head -c 128 /dev/urandom > slurm/munge.key && chmod 600 slurm/munge.key && chmod 755 . slurm");
    const std::string here = "'" + folder_.string() + "'/";
    start("munged --foreground --force --key-file=" + here + "munge.key --socket=" + here + "munge.socket --pid-file=" +
              here + "munged.pid --log-file=" + here + "munged.words --seed-file=" + here + "munge.seed",
          "munged.log");
    constexpr int patience_s = 60;
    if (!within(patience_s, [&] { return fs::exists(folder_ / "munge.socket"); })) {
      why_not_ = "munged did not start\n" + logs();
      return;
    }
    start("slurmctld -D", "slurmctld.log");
    start("slurmd -D -N localhost", "slurmd.log");
    if (!within(patience_s, [&] { return node_is("idle"); })) {
      why_not_ = "its node did not come up\n" + logs();
      return;
    }
    const Outcome step = shell("timeout 60 srun --quiet --ntasks=1 true");
    if (step.status != 0) why_not_ = "it starts nothing: " + step.err + logs();
  }

  void end() const {
    within(60, [] {
      const std::vector<Process> all = all_below();
      for (const Process& one : all) ::kill(one.id, SIGKILL);
      bury();
      return all.empty();
    });
    ::prctl(PR_SET_CHILD_SUBREAPER, 0);
  }

  const Scratch& scratch_;
  fs::path folder_;
  std::string why_not_;
  bool begun_ = false;
};

}  // namespace dresslife::tests
