#include "mc/input/nesting.hpp"

#include <algorithm>
#include <cctype>

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
