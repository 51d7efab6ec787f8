// saca-model-host: the process in which the language model runs, so that nothing it does (hang, run
// out of memory, be killed) can touch the process that steers.
//
//   saca-model-host --model FILE [--threads N] [--context N] [--temperature T] [--give-way]
//                   [--flash-attention]
//       reads requests from standard input and writes events to standard output, one JSON object a
//       line (docs/model-protocol.md); ends when its input ends, or with the process that began it
//
// Exit codes: 0 input ended; 1 the model cannot be loaded; 2 wrong arguments.
#include <llama.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "saca/base/core/standard_files.h"
#include "service.h"

namespace {

pid_t parent_at_start = 0;

// The signal comes when the *thread* that began this process ends; only a lost process matters.
extern "C" void parent_thread_ended(int) {
  if (getppid() != parent_at_start) {
    _exit(0);
  }
}

void end_with_parent() {
  parent_at_start = getppid();
  struct sigaction action {};
  action.sa_handler = parent_thread_ended;
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGUSR1);
}

// OpenMP reads this before main: its threads are to sleep after a short spin (some tens of
// microseconds) instead of holding a core that somebody else needs.
void spin_shortly(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") == nullptr && setenv("GOMP_SPINCOUNT", "10000", 1) == 0) {
    execv("/proc/self/exe", argv);  // returns only when it fails: then the default spin stays
  }
}

int run(int argc, char** argv) {
  saca::model_host::EngineSettings settings;
  settings.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U));
  CLI::App app("Runs SACA's language model in a process of its own");
  app.add_option("--model", settings.model_path, "GGUF file")->required();
  app.add_option("--threads", settings.threads)->check(CLI::Range(1, 64));
  app.add_option("--context", settings.context, "tokens of system part, scene and reply")
      ->check(CLI::Range(256, 8192));
  app.add_option("--temperature", settings.temperature,
                 "by which the logits of the eight answers are divided: above 1 less sure")
      ->check(CLI::Range(0.01, 100.0));
  app.add_flag("--give-way", settings.gives_way,
               "compute with one thread where others want the cores, and write briefly where time "
               "is short; text and the last bits of an answer depend on it");
  app.add_flag("--flash-attention", settings.flash_attention,
               "attention in one pass; the last bits of an answer depend on it");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  end_with_parent();
  llama_log_set([](ggml_log_level, const char*, void*) {}, nullptr);
  return saca::model_host::serve(settings, STDIN_FILENO, std::cout);
}

}  // namespace

int main(int argc, char** argv) {
  saca::occupy_standard_files();
  spin_shortly(argv);
  try {
    return run(argc, argv);
  } catch (const std::exception& problem) {
    std::cerr << "saca-model-host: " << problem.what() << '\n';
    return 1;
  }
}
