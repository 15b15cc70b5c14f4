#pragma once

namespace ejecta {

/// From now on SIGINT and SIGTERM only ask the run to end after the present step; a second one kills the process.
/// Call it after everything that installs handlers of its own (ParaView's Python does).
void install_stop_signals();
bool stop_requested();

}  // namespace ejecta
