#pragma once

namespace ejecta {

/// From now on SIGINT, SIGTERM and SIGHUP (a terminal or connection that closes, unless the run was started by nohup)
/// only ask the run to end after the present step; a second SIGINT or SIGTERM kills the process.
/// Call it after everything that installs handlers of its own (ParaView's Python does).
void install_stop_signals();
bool stop_requested();

}  // namespace ejecta
