#include "mc/files/input/terminal_text.hpp"

#include <sstream>

#include "mc/files/input/input_file.hpp"

namespace gearpod::mc {
namespace {

// Length in bytes of the control character at `at`: 1 for ASCII, 2 for the C1 set in UTF-8; 0 if
// there is none.
std::size_t control_at(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    if (byte(at) < 0x20 || byte(at) == 0x7f) {
        return 1;
    }
    return byte(at) == 0xc2 && byte(at + 1) >= 0x80 && byte(at + 1) < 0xa0 ? 2 : 0;
}

}  // namespace

std::string printable(std::string_view bytes) {
    const std::string text = utf8_text(bytes);
    std::string shown;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = control_at(text, at);
        const bool blank = text[at] == '\n' || text[at] == '\t' || text[at] == '\r';
        shown += length == 0 ? text[at] : blank ? ' ' : '?';
        at += length == 0 ? 1 : length;
    }
    return shown;
}

bool is_printable(std::string_view text) {
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (control_at(text, at) != 0) {
            return false;
        }
    }
    return true;
}

std::string wrapped_text(const std::string& text, std::size_t indent) {
    std::string out, line, word;
    for (std::istringstream words(text); words >> word;) {
        if (line.empty()) {
            line = word;
        } else if (indent + line.size() + 1 + word.size() <= kLineWidth) {
            line += " " + word;
        } else {
            out += line + "\n" + std::string(indent, ' ');
            line = word;
        }
    }
    return out + line;
}

}  // namespace gearpod::mc
