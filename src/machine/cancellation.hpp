// Cooperative cancellation flag. Long computations poll it between their parts (mesh periods,
// gearboxes, tasks of a team) and leave by an exception.
#pragma once

namespace gearpod::machine {

// Thrown by a cancelled computation. It is no std::exception, so that no handler of failed
// computations catches it by mistake.
struct Cancelled {};

// Source of cancellation requests, active for all threads from its construction to its destruction.
// At most one may exist at a time, and it must outlive the computations that it stops.
class CancellationSource {
  public:
    CancellationSource();
    CancellationSource(const CancellationSource&) = delete;
    CancellationSource& operator=(const CancellationSource&) = delete;
    virtual ~CancellationSource();

    // True if computations are to stop. Called often, by any thread.
    virtual bool stop() const = 0;
};

// Throws Stopped if the active CancellationSource requests cancellation.
void throw_if_cancelled();

}  // namespace gearpod::machine
