// A wish from outside that what is being computed ends: computations that may take long look for it
// between their parts (mesh periods, gearboxes, tasks of a team) and leave by an exception.
#pragma once

namespace gearpod::machine {

// No std::exception: nobody who answers a failed computation answers it by mistake.
struct Stopped {};

// Who may wish so. One at a time, for all threads, from its making to its end; it outlives the
// computations that it stops.
class StopWish {
  public:
    StopWish();
    StopWish(const StopWish&) = delete;
    StopWish& operator=(const StopWish&) = delete;
    virtual ~StopWish();

    // Called often, by any thread.
    virtual bool stop() const = 0;
};

// Throws Stopped if there is a wish to stop.
void leave_if_stopped();

}  // namespace gearpod::machine
