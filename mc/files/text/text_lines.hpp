// Reads the lines of a text file, plain or compressed with gzip.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace gearpod::mc {

// Lines end with LF, CR LF or, if the file begins without any LF, CR. UTF-16 with a byte order mark
// is converted to UTF-8; other bytes are passed on unchanged. A quoted field may contain ends of
// lines. All functions throw SignalError (signal_file.hpp).
class TextLines {
  public:
    explicit TextLines(const std::string& path);

    // Gives the next line without its end; false at the end of the file. The view is valid until
    // the next call.
    bool next(std::string_view& line);
    // Number of the last line, from 1.
    long number() const { return number_; }

  private:
    struct Close {
        void operator()(gzFile_s* file) const { gzclose(file); }
    };

    [[noreturn]] void refuse(const std::string& why) const;
    bool fill();
    void check_beginning();
    void append_utf16(bool at_end);
    std::size_t line_length(std::size_t from);
    bool quote_stays_open(std::string_view part, bool open) const;

    std::string path_;
    std::unique_ptr<gzFile_s, Close> file_;
    std::uintmax_t most_bytes_ = 0, bytes_ = 0;  // of a compressed file; bytes read
    std::string buffer_, utf16_;                 // utf16_: bytes that are not yet converted
    std::size_t at_ = 0;                         // beginning of the next line in the buffer
    std::size_t quote_ = 0;                      // first quotation mark at or after at_
    long number_ = 0, next_number_ = 1;
    char end_of_line_ = '\n';
    bool begun_ = false, utf16_little_ = false, utf16_big_ = false;
};

}  // namespace gearpod::mc
