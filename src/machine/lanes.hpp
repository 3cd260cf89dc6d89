// Structure-of-arrays storage: element i of lane l lies at [i * W + l], aligned to a cache line.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace gearpod::machine {

// The numbers of lanes that kernels are built for: 8 doubles fill a 512-bit register, 4 one of 256
// bits; 1 is for comparison.
constexpr bool is_lane_count(int lanes) {
    return lanes == 8 || lanes == 4 || lanes == 1;
}

template <typename T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{64};

    CacheLineAllocator() = default;
    template <typename U>
    explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}

    T* allocate(std::size_t n) {
        return static_cast<T*>(::operator new(n * sizeof(T), kAlignment));
    }
    void deallocate(T* p, std::size_t) { ::operator delete(p, kAlignment); }

    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

using AlignedVector = std::vector<double, CacheLineAllocator<double>>;

}  // namespace gearpod::machine
