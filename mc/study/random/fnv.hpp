// FNV-1a hash with 64 bits (Fowler, Noll, Vo): the same on every machine, unlike std::hash.
#pragma once

#include <cstdint>
#include <string_view>

namespace gearpod::mc {

inline constexpr std::uint64_t kFnvStart = 0xcbf29ce484222325u;

// `hash`: hash of the preceding bytes.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = kFnvStart) {
    for (const char c : bytes) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
    return hash;
}

}  // namespace gearpod::mc
