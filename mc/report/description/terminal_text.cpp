#include "mc/report/description/terminal_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

// Columns in which paragraphs and the values of entries start.
constexpr std::size_t kTextColumn = 2, kValueColumn = 28;

constexpr std::size_t kWidth = 80;

// Elements between the first and last character of an array or inline table.
std::vector<std::string> elements(std::string_view value) {
    std::vector<std::string> all(1);
    int depth = 0;
    bool quoted = false, escaped = false;
    for (std::size_t i = 1; i + 1 < value.size(); ++i) {
        const char c = value[i];
        if (c == '"' && !escaped) {
            quoted = !quoted;
        } else if (!quoted) {
            depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
        }
        escaped = c == '\\' && !escaped;
        if (c == ',' && depth == 0 && !quoted) {
            all.emplace_back();
        } else if (c != ' ' || !all.back().empty()) {
            all.back() += c;
        }
    }
    for (std::string& element : all) {
        element.erase(element.find_last_not_of(' ') + 1);
    }
    return all;
}

std::string wrapped_array(std::string_view key, std::string_view value) {
    std::string text = fmt::format("{} = [\n", key);
    std::string line = "   ";
    for (const std::string& element : elements(value)) {
        if (line.size() + element.size() + 2 > kWidth && line.size() > 3) {
            text += line + "\n";
            line = "   ";
        }
        line += fmt::format(" {},", element);
    }
    return text + line + "\n]\n";
}

std::string wrapped_line(std::string_view line) {
    const std::size_t equals = line.find(" = ");
    if (line.size() <= kWidth || equals == std::string_view::npos) {
        return fmt::format("{}\n", line);
    }
    const std::string_view key = line.substr(0, equals), value = line.substr(equals + 3);
    if (value.front() == '[') {
        return wrapped_array(key, value);
    }
    if (value.front() != '{') {
        return fmt::format("{}\n", line);
    }
    std::string text;
    for (const std::string& element : elements(value)) {
        text += wrapped_line(fmt::format("{}.{}", key, element));
    }
    return text;
}

// The first screen: without headings. Without it, everything is printed.
struct Screen {
    std::set<std::string> shown;
    std::string heading;
    bool begins = false;             // the next entry is the first of its heading
    std::ptrdiff_t lines_left = 35;  // of 40, without the title and the last ones
};
std::optional<Screen> screen;

// Prints the lines of an entry, if the screen shows it and has room.
void print_under_heading(const std::string& name, const std::string& lines) {
    if (screen) {
        const bool shown = screen->shown.contains(screen->heading + ": " + name) ||
                           (!name.empty() && screen->shown.contains(screen->heading + ": *"));
        const auto count = std::ranges::count(lines, '\n') + (screen->begins ? 1 : 0);
        if (!shown || count > screen->lines_left) {
            return;
        }
        screen->lines_left -= count;
        fmt::print("{}", std::exchange(screen->begins, false) ? "\n" : "");
    }
    fmt::print("{}", lines);
}

}  // namespace

void print_first_screen(std::set<std::string> shown) {
    screen.emplace().shown = std::move(shown);
}

void print_heading(const std::string& text) {
    if (screen) {
        screen->heading = text;
        screen->begins = true;
    } else {
        fmt::print("\n{}\n", text);
    }
}

void print_entry(const std::string& name, const std::string& value) {
    print_under_heading(name,
                        fmt::format("  {:<25} {}\n", name, wrapped_text(value, kValueColumn)));
}

void print_paragraph(const std::string& text) {
    print_under_heading("", fmt::format("  {}\n", wrapped_text(text, kTextColumn)));
}

void print_section(const DescriptionSection& section) {
    print_heading(section.heading);
    if (screen && screen->shown.contains(section.heading + ": names")) {
        std::set<std::string> names;
        for (const auto& [name, text] : section.entries) {
            names.insert(name);
        }
        names.erase("");
        print_under_heading(
            "names", fmt::format("  {}\n", wrapped_text(fmt::format("{}: {}", section.heading,
                                                                    fmt::join(names, ", ")),
                                                        kTextColumn + 2)));
        return;
    }
    for (const auto& [name, text] : section.entries) {
        name.empty() ? print_paragraph(text) : print_entry(name, text);
    }
}

std::string wrapped_study(std::string_view toml) {
    std::string text;
    while (!toml.empty()) {
        const std::size_t end = toml.find('\n');
        text += wrapped_line(toml.substr(0, end));
        toml.remove_prefix(end == std::string_view::npos ? toml.size() : end + 1);
    }
    return text;
}

}  // namespace gearpod::mc
