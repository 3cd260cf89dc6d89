// Files before they are opened for reading, and their text of unknown encoding as UTF-8.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gearpod::mc {

// Pipe given as standard input or by a shell (/dev/stdin, /dev/fd/63).
enum class StandardInput { refused, accepted };

// Reason why a file cannot be read, for example "is a folder", or "". Opening a named pipe would
// wait for its writer, and a device may have no end; both are refused.
std::string why_not_readable(const std::string& path, StandardInput pipe = StandardInput::refused);

// The text as valid UTF-8. Bytes that are not UTF-8 are taken as Latin-1, as recorders under
// Windows write it.
std::string utf8_text(std::string_view bytes);

// Number of bytes of the valid UTF-8 character at `at`, 1 to 4; 0 if there is none.
std::size_t utf8_length(std::string_view text, std::size_t at);

// Appends the character with that code.
void append_utf8(std::string& text, std::uint32_t code);

// The text with its letters A to Z in lower case.
std::string lower_case(std::string_view text);

// The text without the blanks around it.
inline std::string_view without_outer_blanks(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlank);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

}  // namespace gearpod::mc
