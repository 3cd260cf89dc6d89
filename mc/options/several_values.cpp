#include "mc/options/several_values.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace gearpod::mc {
namespace {

bool is_option_word(const std::string& word) {
    return word.size() > 1 && word.front() == '-';
}

// True for options that take one value for each time they are given and may be given repeatedly.
// CLI11 itself distributes the values of all others.
bool takes_several(const CLI::Option& option) {
    return option.get_items_expected_max() > 1 && !option.get_allow_extra_args() &&
           option.get_option_text().empty();
}

bool accepts(const CLI::Option& option, const std::string& word) {
    if (option.get_type_name().find('=') != std::string::npos &&
        word.find('=') == std::string::npos) {
        return false;
    }
    const bool split = option.get_delimiter() != '\0';
    const auto values =
        split ? CLI::detail::split(word, option.get_delimiter()) : std::vector<std::string>{word};
    return std::ranges::all_of(
        values, [&](const std::string& value) { return check_problem(option, value).empty(); });
}

// Words after an option that takes several values: indices first to end - 1.
struct ValueRun {
    std::size_t option, first, end;
};

struct Arguments {
    std::vector<ValueRun> runs;
    bool has_free_word = false;  // a word that is no option and no value of one
};

Arguments arguments_of(const CLI::App& command, const std::vector<std::string>& words) {
    Arguments found;
    for (std::size_t at = 0; at < words.size(); ++at) {
        if (words[at] == "--") {
            found.has_free_word = found.has_free_word || at + 1 < words.size();
            break;
        }
        if (!is_option_word(words[at])) {
            found.has_free_word = true;
            continue;
        }
        const CLI::Option* option = command.get_option_no_throw(words[at]);
        if (option == nullptr || option->get_items_expected_max() == 0) {
            continue;  // unknown, a flag, or --name=value
        }
        if (!takes_several(*option)) {
            ++at;
            continue;
        }
        ValueRun run{at, at + 1, at + 2};
        while (run.end < words.size() && !is_option_word(words[run.end]) &&
               accepts(*option, words[run.end])) {
            ++run.end;
        }
        run.end = std::min(run.end, words.size());
        at = run.end - 1;
        found.runs.push_back(run);
    }
    return found;
}

bool needs_file_name(const CLI::App& command) {
    const auto options = command.get_options();
    return std::ranges::any_of(options, [](const CLI::Option* option) {
        return option->get_positional() && option->get_required();
    });
}

// Leaves the last word of a run to the command: of the last run that ends with an existing file,
// otherwise of the last run with two words.
void leave_file_name(const std::vector<std::string>& words, std::vector<ValueRun>& runs) {
    ValueRun* chosen = nullptr;
    bool exists = false;
    for (ValueRun& run : runs) {
        std::error_code none;
        const bool file = run.end > run.first && std::filesystem::exists(words[run.end - 1], none);
        if (run.end - run.first >= 2 && (file || !exists)) {
            chosen = &run;
            exists = file;
        }
    }
    if (chosen != nullptr) {
        --chosen->end;
    }
}

}  // namespace

std::string check_problem(const CLI::Option& option, const std::string& value) {
    // Checks are numbered; get_validator() throws beyond the last one.
    for (int i = 0;; ++i) {
        const CLI::Validator* check = nullptr;
        try {
            check = const_cast<CLI::Option&>(option).get_validator(i);
        } catch (const CLI::OptionNotFound&) {
            return "";
        }
        if (std::string why = (*check)(value); !why.empty()) {
            return why;
        }
    }
}

std::vector<std::string> separate_values(const CLI::App& command,
                                         const std::vector<std::string>& words) {
    Arguments found = arguments_of(command, words);
    if (!found.has_free_word && needs_file_name(command)) {
        leave_file_name(words, found.runs);
    }
    std::vector<std::string> out;
    std::size_t at = 0;
    for (const ValueRun& run : found.runs) {
        out.insert(out.end(), words.begin() + static_cast<std::ptrdiff_t>(at),
                   words.begin() + static_cast<std::ptrdiff_t>(std::min(run.first, words.size())));
        for (std::size_t value = run.first; value < run.end; ++value) {
            if (value > run.first) {
                out.push_back(words[run.option]);
            }
            out.push_back(words[value]);
        }
        at = run.end;
    }
    out.insert(out.end(), words.begin() + static_cast<std::ptrdiff_t>(std::min(at, words.size())),
               words.end());
    return out;
}

}  // namespace gearpod::mc
