#include "mc/files/input/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <utility>

#include "mc/files/input/find_in.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

bool is_bare(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
           static_cast<unsigned char>(c) >= 0x80;
}

class Scan {
  public:
    explicit Scan(std::string_view text) : text_(text) {}

    int run() {
        while (at_ < text_.size()) {
            step();
            if (parts_ > kMostNesting || depth_ > kMostNesting) {
                return line_;
            }
        }
        return 0;
    }

  private:
    // Reads one token: a part of a key or a value, a dot, a bracket, blanks, a comment.
    void step() {
        const char c = text_[at_];
        if (c == '"' || c == '\'') {
            skip_string(c);
            add_part();
        } else if (is_bare(c)) {
            while (at_ < text_.size() && is_bare(text_[at_])) {
                ++at_;
            }
            add_part();
        } else if (c == '#') {
            at_ = std::min(text_.find('\n', at_), text_.size());
        } else {
            ++at_;
            punctuate(c);
        }
    }

    void punctuate(char c) {
        if (c == '.') {
            dot_ = true;
        } else if (c != ' ' && c != '\t') {
            parts_ = 0;
            dot_ = false;
        }
        if (c == '[' || c == '{') {
            ++depth_;
        } else if (c == ']' || c == '}') {
            depth_ = std::max(0, depth_ - 1);
        } else if (c == '\n') {
            ++line_;
        }
    }

    void add_part() {
        parts_ = dot_ ? parts_ + 1 : 1;
        dot_ = false;
    }

    // Skips a string up to its closing quotes, or to the end of the line or text if they are
    // missing.
    void skip_string(char quote) {
        const std::string_view rest = text_.substr(at_);
        const bool many_lines = rest.size() > 2 && rest[1] == quote && rest[2] == quote;
        at_ += many_lines ? 3 : 1;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\n') {
                if (!many_lines) {
                    return;
                }
                ++line_;
            } else if (c == '\\' && quote == '"' && at_ + 1 < text_.size() &&
                       text_[at_ + 1] != '\n') {
                ++at_;
            } else if (c == quote && (!many_lines || closes(quote))) {
                at_ += many_lines ? 3 : 1;
                return;
            }
        }
    }
    bool closes(char quote) const {
        return at_ + 2 < text_.size() && text_[at_ + 1] == quote && text_[at_ + 2] == quote;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1, depth_ = 0, parts_ = 0;
    bool dot_ = false;
};

}  // namespace

int line_nested_too_deep(std::string_view text) {
    return Scan(text).run();
}

}  // namespace gearpod::mc

// toml++ 3.3 asserts conditions that malformed headers such as "[[[" violate, and relies on them in
// release builds (see its pull request 301). Here a violated assertion throws an exception and is
// reported as a syntax error.
namespace gearpod::mc {
struct BrokenAssumption {};
constexpr void require(bool assumption) {
    if (!assumption) {
        throw BrokenAssumption{};
    }
}
}  // namespace gearpod::mc
#undef NDEBUG
#define TOML_ASSERT(expression) ::gearpod::mc::require(static_cast<bool>(expression))
#include <toml++/toml.h>

namespace gearpod::mc {
namespace {

class Converter {
  public:
    explicit Converter(std::string file) : file_(std::move(file)) {}

    Value convert(const toml::node& node) const {
        Value value;
        value.position = position(node.source());
        if (const auto* boolean = node.as_boolean()) {
            value.kind = Value::Kind::boolean;
            value.boolean = boolean->get();
        } else if (const auto* integer = node.as_integer()) {
            value.kind = Value::Kind::integer;
            value.integer = integer->get();
            value.number = static_cast<double>(integer->get());
        } else if (const auto* number = node.as_floating_point()) {
            value.kind = Value::Kind::number;
            value.number = number->get();
        } else if (const auto* text = node.as_string()) {
            value.kind = Value::Kind::text;
            value.text = text->get();
        } else if (const auto* array = node.as_array()) {
            value.kind = Value::Kind::array;
            for (const toml::node& element : *array) {
                value.elements.push_back(convert(element));
            }
        } else if (const auto* table = node.as_table()) {
            for (const auto& [key, child] : *table) {
                value.entries.push_back(
                    {std::string(key.str()), convert(child), position(key.source())});
            }
        } else {
            value.kind = Value::Kind::date;
        }
        return value;
    }

  private:
    Position position(const toml::source_region& source) const {
        return {file_, file_ == kOverrideFile ? 0 : static_cast<int>(source.begin.line)};
    }
    std::string file_;
};

// Message without line breaks; toml++ appends the position, which the problem states separately.
std::string plain_message(std::string_view description) {
    std::string message(description);
    std::replace(message.begin(), message.end(), '\n', ' ');
    return message;
}

bool is_bare_word(std::string_view text) {
    return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) &&
           std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

// toml++ and the reader of its tables are recursive, so nesting is limited.
constexpr std::string_view kNested = "nested deeper than 32 levels";
static_assert(kMostNesting == 32);

// Parses the value of an assignment. A bare word is a string, because shells remove quotes.
bool parse_value(const std::string& text, Value& value, std::string& why) {
    if (line_nested_too_deep(text) != 0) {
        why = kNested;
        return false;
    }
    try {
        const toml::table table = toml::parse("value = " + text, kOverrideFile);
        if (table.size() != 1) {
            why = "it holds more than one value";
            return false;
        }
        value = Converter(std::string(kOverrideFile)).convert(*table.get("value"));
        return true;
    } catch (const toml::parse_error& error) {
        if (is_bare_word(text)) {
            value.kind = Value::Kind::text;
            value.text = text;
            value.position = {std::string(kOverrideFile), 0};
            return true;
        }
        why = plain_message(error.description());
        return false;
    } catch (const BrokenAssumption&) {
        why = "malformed";
        return false;
    }
}

bool violates_assertion(std::string_view text) {
    try {
        static_cast<void>(toml::parse(text));
    } catch (const toml::parse_error&) {
    } catch (const BrokenAssumption&) {
        return true;
    }
    return false;
}

// First line that violates toml++'s assertions. Precondition: the text violates them. Found by
// bisection: text is parsed in order, so every longer prefix violates them, too.
int breaking_line(std::string_view text) {
    std::vector<std::size_t> ends;
    for (std::size_t end = text.find('\n'); end != std::string_view::npos;
         end = text.find('\n', end + 1)) {
        ends.push_back(end);
    }
    const auto whole = std::partition_point(ends.begin(), ends.end(), [&](std::size_t end) {
        return !violates_assertion(text.substr(0, end));
    });
    return 1 + static_cast<int>(whole - ends.begin());
}

std::string trimmed(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && blank(text.back())) {
        text.remove_suffix(1);
    }
    return std::string(text);
}

Entry* find_entry(Value& table, std::string_view name) {
    return find_in(table.entries, name, &Entry::name);
}

// Entry of that name in a table, created if absent. A parent that is no table is replaced by one.
Entry& child(Entry& parent, const std::string& name) {
    const Position at{std::string(kOverrideFile), 0};
    if (parent.value.kind != Value::Kind::table) {
        parent.value = Value{};
        parent.position = parent.value.position = at;
    }
    if (Entry* entry = find_entry(parent.value, name)) {
        return *entry;
    }
    std::vector<Entry>& entries = parent.value.entries;
    entries.push_back({name, {}, at});
    // A section that only an override names does not exist in the file.
    entries.back().value.position = {parent.value.position.file, 0};
    return entries.back();
}

// True if an override set this entry or a part of it.
bool overridden(const Entry& entry) {
    return entry.position.file == kOverrideFile ||
           std::any_of(entry.value.entries.begin(), entry.value.entries.end(), overridden);
}

// Removes the correlations of a random input.
void uncorrelate(Entry& random, const std::string& key) {
    for (Entry& entry : random.value.entries) {
        if (entry.name == "correlations") {
            std::erase_if(entry.value.elements, [&](const Value& pair) {
                const Entry* between = pair.find("between");
                return between != nullptr &&
                       std::ranges::any_of(between->value.elements,
                                           [&](const Value& one) { return one.text == key; });
            });
        }
    }
}

// Removes the distributions in a table of [random] that an override of the same key in `given`
// replaces, and adds the paths of these keys.
void drop_overridden(Value& random, const Value& given, const std::string& prefix,
                     std::vector<std::string>& keys) {
    std::erase_if(random.entries, [&](Entry& key) {
        const Entry* value = given.find(key.name);
        if (value == nullptr) {
            return false;
        }
        if (value->value.kind == Value::Kind::table && key.value.kind == Value::Kind::table) {
            drop_overridden(key.value, value->value, prefix + key.name + ".", keys);
            return false;
        }
        const bool dropped = value->position.file == kOverrideFile && !overridden(key);
        if (dropped) {
            keys.push_back(prefix + key.name);
        }
        return dropped;
    });
}

}  // namespace

std::string quoted_text(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            result += fmt::format("\\u{:04X}", static_cast<int>(c));
        } else {
            result += c;
        }
    }
    return result + "\"";
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

const Entry* Value::find(std::string_view name) const {
    return find_in(entries, name, &Entry::name);
}

std::string Value::shown() const {
    switch (kind) {
        case Kind::boolean:
            return boolean ? "true" : "false";
        case Kind::integer:
            return fmt::format("an integer ({})", integer);
        case Kind::number:
            return fmt::format("a number ({:#})", number);
        case Kind::text:
            return fmt::format("a string (\"{}\")", printable(text));
        case Kind::array:
            return "a list";
        case Kind::table:
            return "a table";
        case Kind::date:
            return "a date";
    }
    return "";
}

Value parse_document(const std::string& text, const std::string& file, Problems& problems) {
    if (const int line = line_nested_too_deep(text); line != 0) {
        problems.push_back({file, line, "", std::string(kNested),
                            "write [section] and key = value; nothing was read"});
        return {};
    }
    try {
        Value document = Converter(file).convert(toml::parse(text, file));
        document.position = {file, 0};
        return document;
    } catch (const toml::parse_error& error) {
        problems.push_back({file, static_cast<int>(error.source().begin.line), "",
                            "not valid TOML (" + plain_message(error.description()) + ")",
                            "correct this line; the rest of the file was not read"});
    } catch (const BrokenAssumption&) {
        problems.push_back({file, breaking_line(text), "", "not valid TOML (malformed)",
                            "correct this line; the rest of the file was not read"});
    }
    return {};
}

void apply_override(Value& document, const std::string& assignment, Problems& problems) {
    const std::size_t equals = assignment.find('=');
    const std::string path = trimmed(assignment.substr(0, equals));
    std::vector<std::string> parts = split(path, '.');
    const bool empty_part =
        std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); });
    const std::string file(kOverrideFile);
    if (equals == std::string::npos || empty_part || parts.size() > kMostNesting) {
        problems.push_back({file, 0, assignment, "not an assignment",
                            "write section.key=value, e.g. ensemble.seed=1"});
        return;
    }
    Value value;
    std::string why;
    if (!parse_value(trimmed(assignment.substr(equals + 1)), value, why)) {
        problems.push_back({file, 0, path, "its value is not valid TOML (" + why + ")",
                            "quote strings: section.key='\"text\"'"});
        return;
    }
    if (value.kind == Value::Kind::table && value.find("distribution") != nullptr &&
        parts.front() != "random") {
        parts.insert(parts.begin(), "random");
    }
    Entry root{"", std::move(document), {}};
    Entry* target = &root;
    for (const std::string& part : parts) {
        target = &child(*target, part);
    }
    target->value = std::move(value);
    target->position = {file, 0};
    document = std::move(root.value);
}

std::vector<std::string> drop_overridden_random(Value& document) {
    std::vector<std::string> keys;
    if (Entry* random = find_entry(document, "random")) {
        drop_overridden(random->value, document, "", keys);
        for (const std::string& key : keys) {
            uncorrelate(*random, key);
        }
    }
    return keys;
}

std::string read_file(const std::string& path, Problems& problems) {
    if (const std::string why = why_not_readable(path, StandardInput::accepted); !why.empty()) {
        problems.push_back({path, 0, "", why, "name an existing study file (*.toml)"});
        return {};
    }
    std::ifstream stream(path, std::ios::binary);
    constexpr std::size_t kMostBytes = std::size_t{1} << 26;
    std::string text, part(std::size_t{1} << 16, '\0');
    while (text.size() <= kMostBytes && stream) {
        stream.read(part.data(), static_cast<std::streamsize>(part.size()));
        text.append(part, 0, static_cast<std::size_t>(stream.gcount()));
    }
    if (text.size() > kMostBytes) {
        problems.push_back({path, 0, "", fmt::format("has more than {} bytes", kMostBytes),
                            "name an existing study file (*.toml)"});
        return {};
    }
    if (stream.bad()) {
        problems.push_back({path, 0, "", "cannot be read (input error)", ""});
    }
    return text;
}

}  // namespace gearpod::mc
