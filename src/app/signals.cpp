#include "app/signals.hpp"

#include <csignal>

namespace ejecta {

namespace {
volatile std::sig_atomic_t stop = 0, checkpoint = 0;  // the one thing a signal handler may write to

void ask_to_stop(int signal) {
  stop = 1;
  // A closing terminal may hang up twice.
  std::signal(signal, signal == SIGHUP ? SIG_IGN : SIG_DFL);
}

void ask_for_checkpoint(int) { checkpoint = 1; }
}  // namespace

void install_signals() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  if (std::signal(SIGHUP, ask_to_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGPIPE, SIG_IGN);
}

void take_checkpoint_signals() { std::signal(SIGUSR1, ask_for_checkpoint); }

bool stop_requested() { return stop != 0; }

bool take_checkpoint_request() {
  const bool asked = checkpoint != 0;
  checkpoint = 0;
  return asked;
}

}  // namespace ejecta
