// Headings, entries and paragraphs of the text printed by `describe`.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "mc/plan/description.hpp"

namespace gearpod::mc {

// Prints only these from now on, without headings, and no more than a screen holds:
// "heading: name" is an entry, "heading: " a paragraph, "heading: *" all entries, and
// "heading: names" their names as one list.
void print_first_screen(std::set<std::string> shown);

void print_heading(const std::string& text);

// Prints a name and a value in two columns, with long values in several lines. Names longer than 25
// characters shift the value to the right.
void print_entry(const std::string& name, const std::string& value);

// Prints a text as indented lines.
void print_paragraph(const std::string& text);

// Prints a heading and its entries.
void print_section(const DescriptionSection& section);

// Study text for a terminal.

// Breaks lines of a study that are longer than 80 characters where TOML allows it: an inline table
// becomes dotted keys, and an array takes several lines. Strings stay whole. The meaning is the
// same.
std::string wrapped_study(std::string_view toml);

}  // namespace gearpod::mc
