#include "analysis/report/text_lines.hpp"

#include <algorithm>

namespace gearpod::analysis {
namespace {

std::size_t columns_of_text = 80;

}  // namespace

std::size_t text_width() {
    return columns_of_text;
}

void set_text_width(std::size_t columns) {
    columns_of_text = std::max<std::size_t>(80, columns);
}

void add_wrapped(std::string& out, const std::string& text, std::size_t indent, std::size_t width) {
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && line.size() + 1 + word.size() > width) {
            out += line + '\n';
            line = std::string(indent, ' ') + word;
        } else {
            line += (line.empty() || at == 0 ? "" : " ") + word;
        }
        at = end + 1;
    }
    out += line + '\n';
}

}  // namespace gearpod::analysis
