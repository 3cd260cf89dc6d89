#include "mc/files/signal_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/files/foreign_file.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/number_text.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kRateNames =
    "sampling fs samplingrate samplerate samplingfrequency samplefrequency samplingfreq samplefreq "
    "sfreq sr samplespersecond acquisitionrate scanrate";
constexpr std::string_view kIntervalNames =
    "wfincrement dt deltat sampleinterval samplinginterval samplingperiod sampleperiod timestep "
    "samplingtime sampletime xincrement";

struct RateSuffix {
    std::string_view text;
    double factor;  // to Hz or s
    bool rate;
};
constexpr RateSuffix kRateSuffixes[] = {{"khz", 1e3, true},  {"hz", 1.0, true}, {"ms", 1e-3, false},
                                        {"us", 1e-6, false}, {"s", 1.0, false}, {"", 1.0, true}};

bool is_interval(const std::string& plain, double& factor) {
    for (const RateSuffix& suffix : kRateSuffixes) {
        if ((!suffix.rate || suffix.text.empty()) && plain.ends_with(suffix.text) &&
            is_among(std::string_view(plain).substr(0, plain.size() - suffix.text.size()),
                     kIntervalNames)) {
            factor = suffix.factor;
            return true;
        }
    }
    return false;
}

}  // namespace

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

std::string group_of(const std::string& name, char separator) {
    const std::size_t end = name.rfind(separator);
    return end == std::string::npos ? "" : name.substr(0, end);
}

std::string leaf_of(const std::string& name, char separator) {
    const std::size_t end = name.rfind(separator);
    return end == std::string::npos ? name : name.substr(end + 1);
}

std::vector<std::string> matching_columns(const std::vector<std::string>& all,
                                          const ColumnChoice& choice, char separator) {
    const auto has = [&](const std::string& name) {
        return std::ranges::find(all, name) != all.end();
    };
    const bool exact = has(choice.name);
    if (exact && (choice.requested || choice.near.empty())) {
        return {choice.name};
    }
    if (!choice.near.empty()) {
        for (std::string group = group_of(choice.near, separator); !group.empty();
             group = group_of(group, separator)) {
            const std::string name = group + separator + choice.name;
            if (has(name)) {
                return {name};
            }
        }
        if (exact || !choice.requested) {
            return exact ? std::vector{choice.name} : std::vector<std::string>{};
        }
    }
    std::vector<std::string> found;
    std::ranges::copy_if(all, std::back_inserter(found), [&](const std::string& name) {
        return name.ends_with(separator + choice.name);
    });
    return found;
}

std::optional<MatrixColumn> matrix_column(const std::string& name) {
    const std::size_t colon = name.rfind(':');
    if (colon == std::string::npos || colon == 0) {
        return std::nullopt;
    }
    const auto column = parsed_number<std::size_t>(std::string_view(name).substr(colon + 1));
    return column ? std::optional(MatrixColumn{name.substr(0, colon), *column}) : std::nullopt;
}

std::string NamedColumns::find(const ColumnChoice& choice) {
    std::vector<std::string> found = matching(choice);
    const auto part = matrix_column(choice.name);
    if (found.empty() && part) {
        found = matching({part->matrix, choice.near, choice.requested});
        for (std::string& name : found) {
            name += fmt::format(":{}", part->column);
        }
    }
    if (found.size() > 1 && choice.requested) {
        throw SignalError(fmt::format("{}: several columns are named {}: {}; give the whole {}",
                                      path_, printable(choice.name), printable(listed_text(found)),
                                      full_name_));
    }
    if (found.size() != 1) {
        return "";
    }
    const std::string problem = problem_of(found.front());
    if (!problem.empty() && choice.requested) {
        throw SignalError(path_ + ": " + problem);
    }
    if (!problem.empty()) {
        add_note(problem + "; it is not used");
        return "";
    }
    // The choice may be a path that begins with a slash, for example.
    if (choice.near.empty() && !choice.name.ends_with(found.front())) {
        add_note(fmt::format("column {} is {}", choice.name, found.front()));
    }
    return found.front();
}

void NamedColumns::add_note(const std::string& text) {
    if (std::ranges::find(notes_, text) == notes_.end()) {
        notes_.push_back(text);
    }
}

std::string shape_text(const std::vector<unsigned long long>& shape) {
    return fmt::format("{}", fmt::join(shape, " x "));
}

std::optional<SignalForm> signal_form(const std::vector<unsigned long long>& shape) {
    std::vector<std::size_t> wide;
    for (std::size_t d = 0; d < shape.size(); ++d) {
        if (shape[d] != 1) {
            wide.push_back(d);
        }
    }
    if (shape.empty() || wide.size() > 2 ||
        (wide.size() == 2 && shape[wide[0]] == shape[wide[1]])) {
        return std::nullopt;
    }
    if (wide.size() < 2) {
        return SignalForm{wide.empty() ? 0 : wide[0], std::nullopt};
    }
    const bool first = shape[wide[0]] > shape[wide[1]];
    return SignalForm{first ? wide[0] : wide[1], first ? wide[1] : wide[0]};
}

std::string plain_name(std::string_view name) {
    std::string plain = lower_case(name);
    std::erase_if(plain, [](char c) { return !(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9'); });
    return plain;
}

std::optional<double> stated_rate_Hz(const NumberStatement& statement) {
    const std::string plain = plain_name(statement.name);
    for (const RateSuffix& suffix : kRateSuffixes) {
        if (suffix.rate && plain.ends_with(suffix.text) &&
            is_among(std::string_view(plain).substr(0, plain.size() - suffix.text.size()),
                     kRateNames) &&
            plain != "sampling") {
            return statement.value * suffix.factor;
        }
    }
    double factor = 1.0;
    return is_interval(plain, factor) ? std::optional(1.0 / (statement.value * factor))
                                      : std::nullopt;
}

std::optional<double> agreed_rate_Hz(const std::vector<NumberStatement>& statements,
                                     const std::string& where) {
    constexpr double kAgreement = 1e-3;
    std::optional<double> rate;
    std::string first;
    bool interval = false;
    for (const NumberStatement& statement : statements) {
        const auto stated = stated_rate_Hz(statement);
        if (!stated) {
            continue;
        }
        if (!(*stated > 0.0 && std::isfinite(*stated))) {
            throw SignalError(fmt::format("{}: {} = {:g} is not a sampling rate or interval", where,
                                          printable(statement.name), statement.value));
        }
        if (rate && std::abs(*stated - *rate) > kAgreement * *rate) {
            throw SignalError(fmt::format(
                "{}: {} states a sampling rate of {:.8g} Hz, but {} one of {:.8g} Hz; give "
                "--sampling-Hz",
                where, printable(first), *rate, printable(statement.name), *stated));
        }
        double unused = 1.0;
        const bool by_interval = is_interval(plain_name(statement.name), unused);
        if (!rate || (interval && !by_interval)) {
            rate = stated;
            first = statement.name;
            interval = by_interval;
        }
    }
    return rate;
}

}  // namespace gearpod::mc
