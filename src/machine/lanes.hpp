// Structure-of-arrays storage: element i of lane l lies at [i * W + l], aligned to a cache line.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace gearpod::machine {

// True for the numbers of lanes that kernels are built for. 8 doubles or 16 floats fill a 512-bit
// register, 4 doubles or 8 floats a 256-bit register, and 1 lane is for comparison. Only float
// kernels have 16 lanes.
constexpr bool is_lane_count(int lanes) {
    return lanes == 16 || lanes == 8 || lanes == 4 || lanes == 1;
}
#define GEARPOD_FOR_DOUBLE_WIDTHS(DO) DO(1, double) DO(4, double) DO(8, double)
#define GEARPOD_FOR_FLOAT_WIDTHS(DO) DO(1, float) DO(4, float) DO(8, float) DO(16, float)
#define GEARPOD_FOR_ALL_WIDTHS(DO) GEARPOD_FOR_DOUBLE_WIDTHS(DO) GEARPOD_FOR_FLOAT_WIDTHS(DO)

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

template <typename T>
using AlignedArray = std::vector<T, CacheLineAllocator<T>>;
using AlignedVector = AlignedArray<double>;

}  // namespace gearpod::machine
