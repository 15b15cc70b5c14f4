#pragma once

namespace ejecta {

/// From now on SIGINT, SIGTERM and SIGHUP (a terminal or connection that closes, unless the run was started by nohup)
/// only ask the run to end after the present step; a second SIGINT or SIGTERM kills the process. SIGPIPE (the other end
/// of a live connection hangs up) is an error of the write. Call it after everything that installs handlers of its own
/// (ParaView's Python does).
void install_signals();
/// From now on SIGUSR1 asks for a checkpoint. It would end the process, and may come while the run is being set up.
void take_checkpoint_signals();
bool stop_requested();
/// True once for every checkpoint that was asked for.
bool take_checkpoint_request();

}  // namespace ejecta
