#include "mc/files/signal_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/files/foreign_file.hpp"
#include "mc/files/input/input_file.hpp"

namespace gearpod::mc {

std::string SignalFile::find(const ColumnChoice& choice) {
    return has(choice.name) ? choice.name : "";
}

std::string SignalFile::contents() {
    return listed_text(names());
}

bool SignalFile::has(const std::string& name) const {
    const auto all = names();
    return std::find(all.begin(), all.end(), name) != all.end();
}

std::string listed_text(const std::vector<std::string>& texts) {
    constexpr std::size_t kShown = 20;
    const auto end = texts.begin() + static_cast<std::ptrdiff_t>(std::min(texts.size(), kShown));
    const std::string rest =
        texts.size() > kShown ? fmt::format(" and {} more", texts.size() - kShown) : "";
    return texts.empty() ? "none" : fmt::format("{}{}", fmt::join(texts.begin(), end, ", "), rest);
}

namespace {

class ColumnsInMemory final : public SignalFile {
  public:
    explicit ColumnsInMemory(std::shared_ptr<const std::vector<SignalColumn>> columns)
        : columns_(std::move(columns)) {}

    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (const SignalColumn& column : *columns_) {
            names.push_back(column.name);
        }
        return names;
    }
    std::vector<double> read(const std::string& name) override { return named(name).values; }
    std::string unit(const std::string& name) override { return named(name).unit; }

  private:
    const SignalColumn& named(const std::string& name) const {
        return *std::ranges::find(*columns_, name, &SignalColumn::name);
    }

    std::shared_ptr<const std::vector<SignalColumn>> columns_;
};

}  // namespace

SignalSource::SignalSource(std::string message_name, std::vector<SignalColumn> in_memory)
    : name(std::move(message_name)),
      columns(std::make_shared<const std::vector<SignalColumn>>(std::move(in_memory))) {}

std::unique_ptr<SignalFile> SignalSource::open(std::optional<std::size_t> row) const {
    if (columns) {
        return std::make_unique<ColumnsInMemory>(columns);
    }
    return open_signal_file(name, row);
}

std::unique_ptr<SignalFile> open_signal_file(const std::string& path,
                                             std::optional<std::size_t> row) {
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw SignalError(path + ": " + why);
    }
    const FileKind kind = file_kind(path);
    if (row && kind != FileKind::hdf5) {
        throw SignalError(path + ": has no rows to select from; only HDF5 files can have rows");
    }
    switch (kind) {
        case FileKind::text:
            return open_signal_csv(path);
        case FileKind::hdf5:
            return open_signal_hdf5(path, row);
        case FileKind::mat:
            return open_signal_foreign(path, "mat");
        case FileKind::sound:
            return open_signal_foreign(path, "sound");
        case FileKind::tdms:
            return open_signal_foreign(path, "tdms");
        case FileKind::uff:
            return open_signal_foreign(path, "uff");
        case FileKind::unknown:
            break;
    }
    throw SignalError(unknown_format_text(path));
}

}  // namespace gearpod::mc
