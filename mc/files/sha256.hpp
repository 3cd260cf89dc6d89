// SHA-256 (FIPS 180-4), as the program sha256sum prints it: identifies the files behind a result.
#pragma once

#include <string>
#include <string_view>

namespace gearpod::mc {

// Hash as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

// Hash of a file; "" if it cannot be read.
std::string file_sha256(const std::string& path);

}  // namespace gearpod::mc
