#pragma once

namespace ejecta {

/// From now on SIGINT, SIGTERM and SIGHUP (a terminal or connection that closes, unless the run was started by nohup)
/// only ask the run to end after the present step; a second SIGINT or SIGTERM kills the process. SIGUSR1 asks for a
/// checkpoint. SIGPIPE (the other end of a live connection hangs up) is an error of the write.
/// Call it after everything that installs handlers of its own (ParaView's Python does).
void install_signals();
bool stop_requested();
/// True once for every checkpoint that was asked for.
bool take_checkpoint_request();

}  // namespace ejecta
