// Channels of recordings of other programs as columns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mc/files/column_search.hpp"
#include "mc/files/foreign_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kTimes = "time";

class SignalForeign final : public NamedColumns {
  public:
    SignalForeign(const std::string& path, const std::string& reader)
        : NamedColumns(path, "name"), file_(path, reader) {
        for (const ForeignChannel& channel : file_.channels()) {
            all_.push_back(channel.name);
        }
        add_notes(file_.note());
    }

    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (const ForeignChannel& channel : file_.channels()) {
            if (channel.problem.empty()) {
                names.push_back(channel.name);
            }
        }
        return names;
    }

    std::string contents() override {
        std::vector<std::string> texts;
        for (const ForeignChannel& channel : file_.channels()) {
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
        const ForeignChannel& channel = file_.channels()[part.channel];
        if (!channel.unreadable.empty()) {
            refuse(channel.unreadable);
        }
        add_notes(channel.note);
        add_sampling(channel);
        return file_.values(part.channel, part.column);
    }

    // Universal files state a quantity and a unit of length in addition to a label.
    std::string unit(const std::string& name) override {
        const ForeignChannel& channel = file_.channels()[part_of(name).channel];
        if (!channel.quantity.empty()) {
            const bool angular =
                !channel.unit.empty() &&
                ((channel.quantity == "displacement" &&
                  unit_factor(Quantity::angle, channel.unit)) ||
                 (channel.quantity == "velocity" && unit_factor(Quantity::speed, channel.unit)));
            return angular ? channel.unit : channel.unit_text;
        }
        const auto factor = unit_factor(Quantity::acceleration, channel.unit);
        const auto lengths = channel.lengths_per_metre;
        // A unit of gravity is no product of the file's units: it agrees with SI only.
        const bool agrees = !factor || !lengths || std::abs(*factor * *lengths - 1.0) < 1e-4 ||
                            (*lengths == 1.0 && channel.unit.find('/') == std::string::npos);
        return agrees ? channel.unit
                      : fmt::format("{} by the function's label, but {} by dataset 164",
                                    channel.unit, channel.unit_by_lengths);
    }

    // Rate of the columns in use, or of the channel; else a number next to the column, or in the
    // groups around it.
    std::optional<double> sampling_Hz_of(const std::string& name) override {
        if (rate_Hz_) {
            return rate_Hz_;
        }
        const auto& channels = file_.channels();
        const auto rated = std::ranges::find_if(channels, [&](const ForeignChannel& channel) {
            return channel.sampling_Hz && (name.empty() || channel.name == name);
        });
        if (rated != channels.end()) {
            return rated->sampling_Hz;
        }
        for (std::string group = group_of(name, file_.separator());;
             group = group_of(group, file_.separator())) {
            std::vector<NumberStatement> statements;
            for (std::size_t c = 0; c < channels.size(); ++c) {
                const std::string leaf = leaf_of(channels[c].name, file_.separator());
                if (group_of(channels[c].name, file_.separator()) == group &&
                    channels[c].problem.empty() && stated_rate_Hz({leaf, 1.0})) {
                    if (channels[c].shape[1] == 1) {
                        statements.push_back({leaf, file_.values(c).front()});
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
        std::vector<std::string> found = matching_columns(all_, choice, file_.separator());
        for (const ForeignChannel& channel : file_.channels()) {
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
        const ForeignChannel& channel = file_.channels()[part.channel];
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
        const auto rate = channel.sampling_Hz, start = channel.start_s;
        if (!channel.times.empty() || !times_.empty()) {
            if (rate || rate_Hz_ ||
                (!times_.empty() && channel.name != times_ && channel.times != times_)) {
                refuse(fmt::format("column {} has other times than the first column in use",
                                   channel.name));
            }
            times_ = times_.empty() ? channel.times : times_;
        }
        if (rate && rate_Hz_ && std::abs(*rate - *rate_Hz_) > kSameRate * *rate_Hz_) {
            refuse(fmt::format("its columns {} and {} have different time steps, {:g} s and {:g} s",
                               rate_column_, channel.name, 1.0 / *rate_Hz_, 1.0 / *rate));
        }
        if (rate && !rate_Hz_) {
            rate_Hz_ = rate;
            rate_column_ = channel.name;
        }
        if (start && start_s_ && rate_Hz_ && std::abs(*start - *start_s_) * *rate_Hz_ > 0.5) {
            refuse(fmt::format("its columns {} and {} start at different times, {:g} s apart",
                               start_column_, channel.name, std::abs(*start - *start_s_)));
        }
        if (start && !start_s_) {
            start_s_ = start;
            start_column_ = channel.name;
        }
    }

    ForeignFile file_;
    std::vector<std::string> all_;
    std::optional<double> rate_Hz_, start_s_;  // of the columns in use
    std::string rate_column_, start_column_;
    std::string times_;  // name of the column with their times
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_foreign(const std::string& path,
                                                const std::string& reader) {
    return std::make_unique<SignalForeign>(path, reader);
}

}  // namespace gearpod::mc
