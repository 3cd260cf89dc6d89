#include <algorithm>
#include <filesystem>

#include "mc/files/formats/file_content.hpp"
#include "mc/files/formats/uff_file.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/isolated_reading.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
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

// Selects the reader of a signal file by the extension of its name.

namespace {

bool is_kind_among(const std::string& extension, std::initializer_list<const char*> all) {
    return std::find(all.begin(), all.end(), extension) != all.end();
}

}  // namespace

std::unique_ptr<SignalFile> open_signal_file(const std::string& path,
                                             std::optional<std::size_t> row) {
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw SignalError(path + ": " + why);
    }
    std::string kind = lower_extension(path);
    const bool compressed = kind == ".gz";
    if (compressed) {
        kind = lower_extension(std::filesystem::path(path).stem());
    }
    const bool hdf5 = kind == ".h5" || kind == ".hdf5";
    if (row && !hdf5) {
        throw SignalError(path + ": has no rows to select from; only HDF5 files can have rows");
    }
    if (is_kind_among(kind, {".csv", ".txt", ".tsv", ".dat", ".asc"})) {
        return open_signal_csv(path);
    }
    check_file_content(path);
    if (compressed) {
        throw SignalError(path +
                          ": only text files are read compressed (.csv.gz, .txt.gz); decompress it "
                          "with gunzip");
    }
    if (hdf5) {
        return isolated_signal(path, [&] { return open_signal_hdf5(path, row); });
    }
    if (kind == ".mat") {
        return isolated_signal(path, [&] { return open_signal_mat(path); });
    }
    if (is_kind_among(kind, {".wav", ".wave", ".bwf", ".rf64", ".w64", ".flac", ".aif", ".aiff",
                             ".aifc", ".au", ".snd", ".caf"})) {
        return isolated_signal(path, [&] { return open_signal_sound(path); });
    }
    if (kind == ".tdms") {
        return isolated_signal(path, [&] { return open_signal_tdms(path); });
    }
    if (std::ranges::count(kUffEndings, kind) > 0) {
        return open_signal_uff(path);
    }
    throw SignalError(path +
                      ": unknown file type; its name must end in .csv, .txt, .h5, .hdf5, .mat, "
                      ".tdms, .uff, .unv, .wav, .rf64, .w64, .flac or .aiff");
}

}  // namespace gearpod::mc
