// Signals that ask a program to stop.
#pragma once

#include <array>
#include <csignal>

namespace gearpod::machine {

// Sent by terminals, by batch queues before a limit, and to all processes of a job at once. The
// process that computes decides how to stop; its child processes ignore them (so does
// analysis/python/gearpod/worker.py).
inline constexpr std::array kStopSignals{SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGHUP};

}  // namespace gearpod::machine
