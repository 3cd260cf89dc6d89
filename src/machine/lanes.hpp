// Structure-of-arrays storage: element i of lane l lies at [i * W + l], aligned to a cache line.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace gearpod::machine {

// Lanes of a tile on the widest vector unit: 8 doubles fill one 512-bit register.
inline constexpr int kLanes = 8;

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
