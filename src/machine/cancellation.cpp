#include "machine/cancellation.hpp"

#include <atomic>

namespace gearpod::machine {
namespace {

std::atomic<const CancellationSource*> active_source{nullptr};

}  // namespace

CancellationSource::CancellationSource() {
    active_source = this;
}

CancellationSource::~CancellationSource() {
    active_source = nullptr;
}

void throw_if_cancelled() {
    const CancellationSource* const present = active_source.load(std::memory_order_acquire);
    if (present != nullptr && present->stop()) {
        throw Cancelled{};
    }
}

}  // namespace gearpod::machine
