// SHA-256 (FIPS 180-4), as the program sha256sum prints it: identifies the files behind a result.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gearpod::mc {

class Sha256 {
  public:
    void add(std::string_view bytes);
    // Hash of all bytes added, as 64 hexadecimal digits. Nothing may be added afterwards.
    std::string hex();

  private:
    void mix_block();

    std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<unsigned char, 64> block_{};
    std::size_t filled_ = 0;    // bytes in the block
    std::uint64_t length_ = 0;  // bytes added
};

std::string sha256(std::string_view bytes);

// Hash of a file; "" if it cannot be read.
std::string file_sha256(const std::string& path);

}  // namespace gearpod::mc
