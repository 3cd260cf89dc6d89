#include "machine/stop.hpp"

#include <atomic>

namespace gearpod::machine {
namespace {

std::atomic<const StopWish*> wish{nullptr};

}  // namespace

StopWish::StopWish() {
    wish = this;
}

StopWish::~StopWish() {
    wish = nullptr;
}

void leave_if_stopped() {
    const StopWish* const present = wish.load(std::memory_order_acquire);
    if (present != nullptr && present->stop()) {
        throw Stopped{};
    }
}

}  // namespace gearpod::machine
