#include "mc/files/text/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "mc/files/foreign_file.hpp"
#include "mc/files/input/file_text.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kTextChunk = std::size_t{1} << 20, kLongestLine = std::size_t{1} << 20;
// Bounds of the text in a compressed file: recordings shrink to a third or a twentieth.
constexpr std::uintmax_t kFreeText = std::uintmax_t{64} << 20, kTextPerByte = 200;

}  // namespace

TextLines::TextLines(const std::string& path) : path_(path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        throw SignalError(path + ": no such file, or it cannot be read");
    }
    file_.reset(gzopen(path.c_str(), "rb"));
    if (!file_) {
        throw SignalError(path + ": no such file, or it cannot be read");
    }
    gzbuffer(file_.get(), 1U << 17);
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    most_bytes_ = kFreeText + kTextPerByte * (error ? 0 : size);
}

void TextLines::refuse(const std::string& why) const {
    throw SignalError(fmt::format("{}: {}", path_, why));
}

// Reads more of the file after moving the current line to the front; false at the end of the file.
bool TextLines::fill() {
    buffer_.erase(0, at_);
    quote_ = quote_ == std::string::npos || quote_ < at_ ? 0 : quote_ - at_;
    at_ = 0;
    const bool wide = utf16_little_ || utf16_big_;
    std::string& target = wide ? utf16_ : buffer_;
    const std::size_t kept = target.size();
    target.resize(kept + kTextChunk);
    const int got = gzread(file_.get(), target.data() + kept, static_cast<unsigned>(kTextChunk));
    target.resize(kept + static_cast<std::size_t>(std::max(got, 0)));
    int state = Z_OK;
    const char* const message = gzerror(file_.get(), &state);
    if (state == Z_BUF_ERROR) {
        refuse("the compressed data end too early: the file is truncated");
    }
    if (got < 0) {
        refuse(state == Z_ERRNO ? "cannot be read to its end"
                                : fmt::format("the compressed data are damaged ({})", message));
    }
    bytes_ += static_cast<std::uintmax_t>(got);
    if (gzdirect(file_.get()) == 0 && bytes_ > most_bytes_) {
        refuse(fmt::format("holds more than {} MB of text, over {} times its size: not a recording",
                           most_bytes_ >> 20, kTextPerByte));
    }
    std::size_t checked = wide ? buffer_.size() : kept;
    if (!begun_) {
        begun_ = true;
        check_beginning();
        checked = 0;
    } else if (wide) {
        append_utf16(got == 0);
    }
    const std::size_t null = buffer_.find('\0', checked);
    if (null != std::string::npos) {
        const auto lines =
            std::count(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(null), '\n');
        throw SignalError(
            fmt::format("{}:{}: is not a line of text (UTF-16 needs a byte order mark)\n{}", path_,
                        next_number_ + lines, unknown_format_text(path_)));
    }
    return got > 0;
}

// Recognizes the byte order mark and the end of lines.
void TextLines::check_beginning() {
    if (buffer_.starts_with("\xEF\xBB\xBF")) {
        buffer_.erase(0, 3);
    } else if (buffer_.starts_with("\xFF\xFE") || buffer_.starts_with("\xFE\xFF")) {
        utf16_little_ = buffer_.front() == '\xFF';
        utf16_big_ = !utf16_little_;
        utf16_ = buffer_.substr(2);
        buffer_.clear();
        append_utf16(false);
    }
    if (buffer_.starts_with('<') || buffer_.starts_with("PK\x03\x04")) {
        throw SignalError(unknown_format_text(path_));
    }
    if (buffer_.find('\n') == std::string::npos && buffer_.find('\r') != std::string::npos) {
        end_of_line_ = '\r';
    }
}

void TextLines::append_utf16(bool at_end) {
    const auto unit = [&](std::size_t i) {
        const auto first = static_cast<unsigned char>(utf16_[i]),
                   second = static_cast<unsigned char>(utf16_[i + 1]);
        return static_cast<std::uint32_t>(utf16_little_ ? first | second << 8
                                                        : first << 8 | second);
    };
    std::size_t i = 0;
    for (; i + 1 < utf16_.size(); i += 2) {
        std::uint32_t code = unit(i);
        if (code >= 0xd800 && code < 0xdc00) {
            if (i + 3 >= utf16_.size()) {
                break;
            }
            const std::uint32_t low = unit(i + 2);
            if (low < 0xdc00 || low > 0xdfff) {
                refuse("is not valid UTF-16");
            }
            code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
            i += 2;
        } else if (code >= 0xdc00 && code < 0xe000) {
            refuse("is not valid UTF-16");
        }
        append_utf8(buffer_, code);
    }
    utf16_.erase(0, i);
    if (at_end && !utf16_.empty()) {
        refuse("is not valid UTF-16");
    }
}

// Length of the line at at_, whose first `from` bytes are known to have no end.
std::size_t TextLines::line_length(std::size_t from) {
    for (;;) {
        const std::size_t end = buffer_.find(end_of_line_, at_ + from);
        if (end != std::string::npos) {
            return end - at_;
        }
        from = buffer_.size() - at_;
        if (from > kLongestLine) {
            throw SignalError(fmt::format("{}:{}: is not a line of text: longer than {} bytes",
                                          path_, next_number_, kLongestLine));
        }
        if (!fill()) {
            return buffer_.size() - at_;
        }
    }
}

// True if a quoted field continues after this part of a line. A quotation mark opens a field only
// at its beginning.
bool TextLines::quote_stays_open(std::string_view part, bool open) const {
    char before = ',';
    for (std::size_t i = 0; i < part.size(); ++i) {
        const char c = part[i];
        if (c == '"' && open) {
            if (i + 1 < part.size() && part[i + 1] == '"') {
                ++i;
            } else {
                open = false;
            }
        } else if (c == '"' && std::string_view(",;\t ").find(before) != std::string_view::npos) {
            open = true;
        }
        before = c;
    }
    return open;
}

bool TextLines::next(std::string_view& line) {
    if (at_ >= buffer_.size() && !fill() && at_ >= buffer_.size()) {
        return false;
    }
    number_ = next_number_;
    std::size_t from = 0, length = 0;
    for (bool open = false;;) {
        length = line_length(from);
        ++next_number_;
        if (quote_ != std::string::npos && quote_ < at_) {
            quote_ = at_;
        }
        if (quote_ != std::string::npos) {
            quote_ = buffer_.find('"', quote_);
        }
        const std::string_view all(buffer_.data() + at_, length);
        if (quote_ == std::string::npos || quote_ >= at_ + length) {
            if (!open) {
                break;
            }
        } else if (all.find_first_not_of(" \t") == all.find('#')) {
            break;  // a comment
        }
        open = quote_stays_open(all.substr(from), open);
        if (!open) {
            break;
        }
        from = length + 1;
        if (at_ + from > buffer_.size() && !fill() && at_ + from > buffer_.size()) {
            throw SignalError(fmt::format("{}:{}: a quotation mark is not closed", path_, number_));
        }
        if (from > kLongestLine) {
            throw SignalError(fmt::format("{}:{}: a quotation mark is not closed", path_, number_));
        }
    }
    line = std::string_view(buffer_.data() + at_, length);
    if (line.ends_with('\r')) {
        line.remove_suffix(1);
    }
    at_ = std::min(at_ + length + 1, buffer_.size());
    return true;
}

}  // namespace gearpod::mc
