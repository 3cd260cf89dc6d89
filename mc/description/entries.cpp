#include "mc/description/entries.hpp"

#include <fmt/core.h>

#include <cstddef>

#include "mc/input/wrapped_text.hpp"

namespace gearpod::mc {
namespace {

// Columns in which paragraphs and the values of entries start.
constexpr std::size_t kTextColumn = 2, kValueColumn = 28;

}  // namespace

void print_heading(const std::string& text) {
    fmt::print("\n{}\n", text);
}

void print_entry(const std::string& name, const std::string& value) {
    fmt::print("  {:<25} {}\n", name, wrapped_text(value, kValueColumn));
}

void print_paragraph(const std::string& text) {
    fmt::print("  {}\n", wrapped_text(text, kTextColumn));
}

}  // namespace gearpod::mc
