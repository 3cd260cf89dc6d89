// Channels of TDMS files as columns, with their scaling.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

#include "mc/files/formats/common_sampling.hpp"
#include "mc/files/formats/tdms_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

constexpr std::uint32_t kRawInput = 0xFFFFFFFF;  // input of a scale
constexpr int kMostScales = 64;

// Scale of a channel: a polynomial in the values of its input.
struct TdmsScale {
    std::vector<double> coefficients;  // from the constant to the highest power
    std::uint32_t input = kRawInput;   // number of another scale, or the raw data
};

double polynomial_value(const std::vector<double>& coefficients, double x) {
    double value = 0.0;
    for (std::size_t i = coefficients.size(); i-- > 0;) {
        value = value * x + coefficients[i];
    }
    return value;
}

class SignalTdms : public SignalFile {
  public:
    explicit SignalTdms(const std::string& path)
        : path_(path), file_(read_tdms(path)), stream_(path, std::ios::binary) {
        name_columns();
        if (columns_.empty()) {
            std::string all;
            for (const TdmsChannel& channel : file_.channels) {
                all += (all.empty() ? "" : ", ") + channel.path;
            }
            refuse(fmt::format("has no channel with numbers or times; its channels are {}",
                               all.empty() ? "none" : printable(all.substr(0, 400))));
        }
    }

    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (const Column& column : columns_) {
            names.push_back(column.name);
        }
        return names;
    }

    // A channel is found by its full name, or by its own name: in the group of `near`, or else,
    // unless it is a default name, in the only group that has it.
    std::string find(const ColumnChoice& choice) override {
        if (has(choice.name)) {
            return choice.name;
        }
        const auto near = std::ranges::find(columns_, choice.near, &Column::name);
        std::vector<std::string> found;
        for (const Column& column : columns_) {
            if (column.channel->name == choice.name) {
                if (near != columns_.end() && column.channel->group == near->channel->group) {
                    return column.name;
                }
                found.push_back(column.name);
            }
        }
        if (found.size() > 1 && choice.requested) {
            refuse(fmt::format("{} is the name of several channels: {}", printable(choice.name),
                               printable(listed_text(found))));
        }
        const bool elsewhere = near == columns_.end() || choice.requested;
        return found.size() == 1 && elsewhere ? found.front() : "";
    }

    std::vector<std::string> notes() override {
        return file_.closed ? std::vector<std::string>()
                            : std::vector<std::string>{
                                  "the file was not closed; values after the last complete ones "
                                  "are missing"};
    }

    std::vector<double> read(const std::string& name) override {
        const TdmsChannel& channel = *of(name);
        if (channel.type == TdmsType::timestamp) {
            return times(channel);
        }
        std::vector<double> values = scaled(channel, name);
        sampling_.add(path_, name, rate_Hz(channel), start_s(channel));
        return values;
    }

    // Seconds for points in time, which are given from the first one.
    std::string unit(const std::string& name) override {
        const TdmsChannel& channel = *of(name);
        if (channel.type == TdmsType::timestamp) {
            return "s";
        }
        const std::string* unit = text_of(channel.properties, "unit_string");
        if (unit == nullptr || unit->empty()) {
            unit = text_of(channel.properties, "NI_UnitDescription");
        }
        return unit == nullptr ? "" : *unit;
    }

    std::optional<double> sampling_Hz() override { return sampling_.rate_Hz(); }

  private:
    struct Column {
        std::string name;
        const TdmsChannel* channel;
    };

    [[noreturn]] void refuse(const std::string& why) const {
        throw SignalError(path_ + ": " + why);
    }

    // Columns are "group/channel"; if two have the same name, they have the names of the format.
    void name_columns() {
        std::map<std::string, int> counts;
        const auto full_name = [](const TdmsChannel& channel) {
            return channel.group + "/" + channel.name;
        };
        for (const TdmsChannel& channel : file_.channels) {
            ++counts[full_name(channel)];
        }
        for (const TdmsChannel& channel : file_.channels) {
            if (!channel.raw.empty() &&
                (is_tdms_number(channel.type) || channel.type == TdmsType::timestamp)) {
                const std::string name = full_name(channel);
                columns_.push_back({counts[name] == 1 ? name : channel.path, &channel});
            }
        }
    }
    const TdmsChannel* of(const std::string& name) const {
        return std::ranges::find(columns_, name, &Column::name)->channel;
    }

    static const TdmsProperty* property(const TdmsProperties& properties, const std::string& name) {
        const auto found = properties.find(name);
        return found == properties.end() ? nullptr : &found->second;
    }
    static const std::string* text_of(const TdmsProperties& properties, const std::string& name) {
        return std::get_if<std::string>(property(properties, name));
    }
    static std::optional<double> number_of(const TdmsProperties& properties,
                                           const std::string& name) {
        const auto* number = std::get_if<double>(property(properties, name));
        return number == nullptr ? std::nullopt : std::optional(*number);
    }

    // Sampling rate of a waveform; absent if its abscissa is not time.
    std::optional<double> rate_Hz(const TdmsChannel& channel) const {
        const auto step = number_of(channel.properties, "wf_increment");
        const std::string* unit = text_of(channel.properties, "wf_xunit_string");
        const auto second = unit_factor(Quantity::time, unit == nullptr ? "" : *unit);
        if (!step || !second || *step == 0.0) {
            return std::nullopt;
        }
        const double seconds = *step * *second;
        if (!(seconds > 0.0 && std::isfinite(1.0 / seconds))) {
            refuse(fmt::format("{}: {:g} s is not a valid time step (wf_increment)",
                               printable(channel.path), seconds));
        }
        return 1.0 / seconds;
    }
    // Start of a waveform: seconds from the start of the first waveform of the file.
    std::optional<double> start_s(const TdmsChannel& channel) const {
        const auto offset = number_of(channel.properties, "wf_start_offset");
        const auto* start = std::get_if<TdmsTime>(property(channel.properties, "wf_start_time"));
        if (!offset && start == nullptr) {
            return std::nullopt;
        }
        double since = 0.0;
        for (const TdmsChannel& other : file_.channels) {
            const auto* first = std::get_if<TdmsTime>(property(other.properties, "wf_start_time"));
            if (first != nullptr && start != nullptr) {
                since = start->since(*first);
                break;
            }
        }
        return since + offset.value_or(0.0);
    }

    // Calls `use` with the bytes, the position and the block of every raw value.
    void each_value(
        const TdmsRaw& raw,
        const std::function<void(std::string_view, std::size_t, const TdmsBlock&)>& use) {
        constexpr std::uint64_t kBytes = 1 << 20;
        std::string bytes;
        for (const TdmsBlock& block : raw.blocks) {
            const std::uint64_t width = tdms_width(block.type);
            const std::uint64_t at_once = std::max<std::uint64_t>(1, kBytes / block.stride);
            for (std::uint64_t done = 0; done < block.count;) {
                const std::uint64_t count = std::min(at_once, block.count - done);
                bytes.resize((count - 1) * block.stride + width);
                stream_.clear();
                stream_.seekg(static_cast<std::streamoff>(block.first + done * block.stride));
                if (!stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
                    refuse("is truncated");
                }
                for (std::uint64_t i = 0; i < count; ++i) {
                    use(bytes, i * block.stride, block);
                }
                done += count;
            }
        }
    }

    std::vector<double> times(const TdmsChannel& channel) {
        std::optional<TdmsTime> first;
        std::vector<double> seconds;
        each_value(channel.raw.front(),
                   [&](std::string_view bytes, std::size_t at, const TdmsBlock& block) {
                       const TdmsTime time = tdms_time(bytes, at, block.big_endian);
                       first = first ? first : time;
                       seconds.push_back(time.since(*first));
                   });
        return seconds;
    }
    std::vector<double> numbers(const TdmsRaw& raw) {
        std::vector<double> values;
        each_value(raw, [&](std::string_view bytes, std::size_t at, const TdmsBlock& block) {
            values.push_back(tdms_number(bytes, at, block.type, block.big_endian));
        });
        return values;
    }

    // Values after the last of the channel's scales.
    std::vector<double> scaled(const TdmsChannel& channel, const std::string& name) {
        const auto group = file_.groups.find(channel.group);
        const TdmsProperties* holders[] = {&channel.properties,
                                           group == file_.groups.end() ? nullptr : &group->second,
                                           &file_.properties};
        for (const TdmsProperties* holder : holders) {
            const auto count =
                holder == nullptr ? std::nullopt : number_of(*holder, "NI_Number_Of_Scales");
            if (!count) {
                continue;
            }
            const std::string* status = text_of(*holder, "NI_Scaling_Status");
            if (status != nullptr && *status != "unscaled" && !channel.daqmx) {
                if (*status == "scaled") {
                    break;
                }
                refuse(fmt::format("column {}: its scaling status \"{}\" is unknown",
                                   printable(name), printable(*status)));
            }
            if (!(*count >= 0.0 && *count <= kMostScales)) {
                refuse(fmt::format("column {}: {:g} is not a valid number of scales",
                                   printable(name), *count));
            }
            if (*count > 0.0) {
                return evaluate(channel, name, *holder, static_cast<std::uint32_t>(*count) - 1);
            }
        }
        return numbers(channel.raw.front());
    }

    std::vector<double> evaluate(const TdmsChannel& channel, const std::string& name,
                                 const TdmsProperties& holder, std::uint32_t scale) {
        std::vector<TdmsScale> chain;  // from the last to the first
        const TdmsRaw* raw = nullptr;
        while (raw == nullptr) {
            const auto own = std::ranges::find(channel.raw, scale, &TdmsRaw::scale);
            if (channel.daqmx && own != channel.raw.end()) {
                raw = &*own;
            } else if (scale == kRawInput) {
                raw = &channel.raw.front();
            } else if (chain.size() == kMostScales) {
                refuse(fmt::format("column {}: its scales form a circle", printable(name)));
            } else {
                chain.push_back(scale_of(holder, name, scale));
                scale = chain.back().input;
            }
        }
        std::vector<double> values = numbers(*raw);
        for (std::size_t i = chain.size(); i-- > 0;) {
            for (double& value : values) {
                value = polynomial_value(chain[i].coefficients, value);
            }
        }
        return values;
    }

    TdmsScale scale_of(const TdmsProperties& holder, const std::string& name,
                       std::uint32_t number) const {
        const std::string prefix = fmt::format("NI_Scale[{}]_", number);
        const std::string* type = text_of(holder, prefix + "Scale_Type");
        const auto value = [&](const std::string& key) {
            const auto found = number_of(holder, prefix + key);
            if (!found) {
                refuse(fmt::format("column {}: its scaling lacks the property {}{}",
                                   printable(name), prefix, key));
            }
            return *found;
        };
        if (type == nullptr || (*type != "Linear" && *type != "Polynomial")) {
            refuse(
                fmt::format("column {}: its scaling {} is not supported; save the file with "
                            "scaled values, or export it as CSV",
                            printable(name),
                            type == nullptr ? fmt::format("{} is not stated, which", number)
                                            : printable(*type)));
        }
        TdmsScale scale;
        const auto input = number_of(holder, prefix + *type + "_Input_Source");
        scale.input = input && *input >= 0.0 && *input < kRawInput
                          ? static_cast<std::uint32_t>(*input)
                          : kRawInput;
        if (*type == "Linear") {
            scale.coefficients = {value("Linear_Y_Intercept"), value("Linear_Slope")};
            return scale;
        }
        const double count =
            number_of(holder, prefix + "Polynomial_Coefficients_Size").value_or(4.0);
        for (int i = 0; i < count && i < kMostScales; ++i) {
            scale.coefficients.push_back(value(fmt::format("Polynomial_Coefficients[{}]", i)));
        }
        return scale;
    }

    std::string path_;
    TdmsFile file_;
    std::ifstream stream_;
    std::vector<Column> columns_;
    CommonSampling sampling_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_tdms(const std::string& path) {
    return std::make_unique<SignalTdms>(path);
}

}  // namespace gearpod::mc
