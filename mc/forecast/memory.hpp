// Memory of this process and of this machine.
#pragma once

namespace gearpod::mc {

// Peak memory of this process so far; 0 if the system does not report it.
double peak_memory_bytes();

// Memory that this process may still allocate: the minimum for the machine, its control group and
// its own limit.
double available_memory_bytes();

}  // namespace gearpod::mc
