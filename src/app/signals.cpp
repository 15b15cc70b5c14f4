#include "app/signals.hpp"

#include <csignal>

namespace ejecta {

namespace {
volatile std::sig_atomic_t stop = 0;  // the one thing a signal handler may write to

void ask_to_stop(int signal) {
  stop = 1;
  std::signal(signal, SIG_DFL);
}
}  // namespace

void install_stop_signals() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}
bool stop_requested() { return stop != 0; }

}  // namespace ejecta
