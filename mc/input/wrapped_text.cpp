#include "mc/input/wrapped_text.hpp"

#include <sstream>

namespace gearpod::mc {

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
