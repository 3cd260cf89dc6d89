// Text of files of unknown encoding as UTF-8.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gearpod::mc {

// The text as valid UTF-8. Bytes that are not UTF-8 are taken as Latin-1, as recorders under
// Windows write it.
std::string utf8_text(std::string_view bytes);

// Number of bytes of the valid UTF-8 character at `at`, 1 to 4; 0 if there is none.
std::size_t utf8_length(std::string_view text, std::size_t at);

// Appends the character with that code.
void append_utf8(std::string& text, std::uint32_t code);

// The text with its letters A to Z in lower case.
std::string lower_case(std::string_view text);

}  // namespace gearpod::mc
