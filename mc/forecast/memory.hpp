// Memory of this process and of this machine.
#pragma once

namespace gearpod::mc {

// The most memory this process has had so far; 0 if the system does not say.
double peak_memory_bytes();

// What this process may still take: of the machine, of its control group, of its own limit.
double memory_at_hand_bytes();

}  // namespace gearpod::mc
