// Channels of recordings of other programs as columns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "machine/no_value.hpp"
#include "mc/files/foreign_file.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kTimes = "time";

// Channel of a recording, as Python states it (signal_files.py). Empty texts and NaN are not
// stated.
struct ForeignChannel {
    std::string name, title;  // the title is another name
    std::string text;         // name and shape in lists of channels
    std::string unit;
    std::string times;       // name of the channel with the times of the samples
    std::string note;        // lines to report if the channel is used
    std::string problem;     // reason why it is not a column of numbers
    std::string unreadable;  // reason why its values cannot be read
    double sampling_Hz = kNan, start_s = kNan;
    Shape shape;  // columns of a matrix, and samples
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ForeignChannel, name, title, text, unit, times,
                                                note, problem, unreadable, sampling_Hz, start_s,
                                                shape)

class SignalForeign final : public NamedColumns {
  public:
    SignalForeign(const std::string& path, const std::string& reader) : NamedColumns(path, "name") {
        const PythonOutputFile output(path, reader);
        try {
            file_.emplace(open_file(output.name(), path));
            const auto stated = nlohmann::json::parse(read_text(file_->get(), ".", "recording"));
            separator_ = stated["separator"].get<std::string>().front();
            add_notes(stated["note"]);
            channels_ = stated["channels"];
            std::ranges::transform(channels_, std::back_inserter(all_), &ForeignChannel::name);
        } catch (const std::exception& error) {
            throw SignalError(fmt::format("{}: what Python has read cannot be taken over ({})",
                                          path, error.what()));
        }
    }

    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (const ForeignChannel& channel : channels_) {
            if (channel.problem.empty()) {
                names.push_back(channel.name);
            }
        }
        return names;
    }

    std::string contents() override {
        std::vector<std::string> texts;
        for (const ForeignChannel& channel : channels_) {
            texts.push_back(printable(channel.text));
        }
        return listed_text(texts);
    }

    // Columns may have times of their own.
    std::string find(const ColumnChoice& choice) override {
        return choice.name == kTimes && !choice.requested && !times_.empty()
                   ? times_
                   : NamedColumns::find(choice);
    }

    std::vector<double> read(const std::string& name) override {
        const auto part = part_of(name);
        const ForeignChannel& channel = channels_[part.channel];
        if (!channel.unreadable.empty()) {
            refuse(channel.unreadable);
        }
        add_notes(channel.note);
        add_sampling(channel);
        return values(part);
    }

    std::string unit(const std::string& name) override {
        return channels_[part_of(name).channel].unit;
    }

    // Rate of the columns in use, or of the channel; else a number next to the column, or in the
    // groups around it.
    std::optional<double> sampling_Hz_of(const std::string& name) override {
        if (!std::isnan(rate_Hz_)) {
            return rate_Hz_;
        }
        const auto rated = std::ranges::find_if(channels_, [&](const ForeignChannel& channel) {
            return !std::isnan(channel.sampling_Hz) && (name.empty() || channel.name == name);
        });
        if (rated != channels_.end()) {
            return rated->sampling_Hz;
        }
        for (std::string group = group_of(name, separator_);; group = group_of(group, separator_)) {
            std::vector<NumberStatement> statements;
            for (std::size_t c = 0; c < channels_.size(); ++c) {
                const std::string leaf = leaf_of(channels_[c].name, separator_);
                if (group_of(channels_[c].name, separator_) == group &&
                    channels_[c].problem.empty() && stated_rate_Hz({leaf, 1.0})) {
                    if (channels_[c].shape[1] == 1) {
                        statements.push_back({leaf, values({c, 0}).front()});
                    } else if (leaf == "sampling_Hz") {
                        refuse("sampling_Hz must be one number");
                    }
                }
            }
            if (!statements.empty() || group.empty()) {
                return agreed_rate_Hz(statements, path_);
            }
        }
    }

  private:
    struct Part {
        std::size_t channel, column;
    };

    std::vector<double> values(const Part& part) const {
        const ForeignChannel& channel = channels_[part.channel];
        try {
            std::vector<double> values;
            read_rows(file_->get(), fmt::format("{:06}", part.channel), channel.shape,
                      {part.column, 1}, values);
            return values;
        } catch (const Hdf5Error&) {
            refuse(channel.name + " cannot be read");
        }
    }
    [[noreturn]] void refuse(const std::string& why) const {
        throw SignalError(fmt::format("{}: {}", path_, printable(why)));
    }
    void add_notes(const std::string& lines) {
        std::istringstream stream(lines);
        for (std::string line; std::getline(stream, line);) {
            add_note(line);
        }
    }
    std::vector<std::string> matching(const ColumnChoice& choice) const override {
        std::vector<std::string> found = matching_columns(all_, choice, separator_);
        for (const ForeignChannel& channel : channels_) {
            if (!channel.title.empty() && channel.title == choice.name &&
                std::ranges::find(all_, choice.name) == all_.end()) {
                found.push_back(channel.name);
            }
        }
        return found;
    }
    // The channel, or the matrix of "data:2".
    Part part_of(const std::string& name) const {
        const auto exact = std::ranges::find(all_, name);
        const auto part = matrix_column(name);
        const auto channel =
            exact == all_.end() && part ? std::ranges::find(all_, part->matrix) : exact;
        return {static_cast<std::size_t>(channel - all_.begin()),
                exact == all_.end() && part ? part->column - 1 : 0};
    }
    std::string problem_of(const std::string& name) const override {
        const Part part = part_of(name);
        const ForeignChannel& channel = channels_[part.channel];
        if (channel.name == name || (!channel.problem.empty() && channel.shape[0] == 1)) {
            return printable(channel.problem);
        }
        return part.column < channel.shape[0]
                   ? ""
                   : fmt::format("{}: {} has {} columns, counted from 1", printable(name),
                                 printable(channel.name), channel.shape[0]);
    }

    // Samples of columns in use must be at the same times.
    void add_sampling(const ForeignChannel& channel) {
        constexpr double kSameRate = 1e-9;
        const double rate = channel.sampling_Hz, start = channel.start_s;
        if (!channel.times.empty() || !times_.empty()) {
            if (!std::isnan(rate) || !std::isnan(rate_Hz_) ||
                (!times_.empty() && channel.name != times_ && channel.times != times_)) {
                refuse(fmt::format("column {} has other times than the first column in use",
                                   channel.name));
            }
            times_ = times_.empty() ? channel.times : times_;
        }
        if (std::abs(rate - rate_Hz_) > kSameRate * rate_Hz_) {
            refuse(fmt::format("its columns {} and {} have different time steps, {:g} s and {:g} s",
                               rate_column_, channel.name, 1.0 / rate_Hz_, 1.0 / rate));
        }
        if (std::isnan(rate_Hz_)) {
            rate_Hz_ = rate;
            rate_column_ = channel.name;
        }
        if (std::abs(start - start_s_) * rate_Hz_ > 0.5) {
            refuse(fmt::format("its columns {} and {} start at different times, {:g} s apart",
                               start_column_, channel.name, std::abs(start - start_s_)));
        }
        if (std::isnan(start_s_)) {
            start_s_ = start;
            start_column_ = channel.name;
        }
    }

    std::optional<Hdf5Handle> file_;
    char separator_ = '/';  // between the parts of a channel's name
    std::vector<ForeignChannel> channels_;
    std::vector<std::string> all_;
    double rate_Hz_ = kNan, start_s_ = kNan;  // of the columns in use
    std::string rate_column_, start_column_;
    std::string times_;  // name of the column with their times
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_foreign(const std::string& path,
                                                const std::string& reader) {
    return std::make_unique<SignalForeign>(path, reader);
}

}  // namespace gearpod::mc
