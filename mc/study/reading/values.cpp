#include <fmt/format.h>

#include "mc/files/input/spelling.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/study/distributions/range.hpp"
#include "mc/study/elements/list_element.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/former_keys.hpp"

namespace gearpod::mc {
namespace {

class ValueReader {
  public:
    ValueReader(StudyDraft& draft, const Key& key, const Entry& entry)
        : draft_(draft), key_(key), value_(entry.value), at_(entry.position) {}

    void operator()(const NumberAccess& access) {
        if (finite(value_) && in_range(value_.number)) {
            access.set(draft_.study, value_.number * key_.unit.to_si);
        }
    }

    void operator()(const IntegerAccess& access) {
        if (value_.kind != Value::Kind::integer) {
            reject(fmt::format("must be an integer, but is {}", value_.shown()), key_.range.hint());
        } else if (in_range(value_.number)) {
            access.set(draft_.study, value_.integer);
        }
    }

    void operator()(const BooleanAccess& access) {
        if (value_.kind != Value::Kind::boolean) {
            reject(fmt::format("must be true or false, but is {}", value_.shown()), "");
        } else {
            access.set(draft_.study, value_.boolean);
        }
    }

    void operator()(const ChoiceAccess& access) {
        const std::string text = current_spelling();
        std::vector<std::string_view> names;
        for (const ChoiceName& name : access.names) {
            names.push_back(name.text);
            if (value_.kind == Value::Kind::text && text == name.text) {
                access.set(draft_.study, name.value);
                return;
            }
        }
        if (const FormerValue* former = former_value(key_.path(), text)) {
            reject(fmt::format("\"{}\" of an earlier version was removed", text),
                   fmt::format("use \"{}\"", former->current));
            return;
        }
        const std::string choices = fmt::format("use one of \"{}\"", fmt::join(names, "\", \""));
        if (value_.kind != Value::Kind::text) {
            reject(fmt::format("must be a string, but is {}", value_.shown()), choices);
        } else {
            const std::string meant = suggest(value_.text, names);
            reject(fmt::format("unknown value \"{}\"", value_.text),
                   meant.starts_with("did you mean") ? meant + " Or " + choices : choices);
        }
    }

    void operator()(const NumbersAccess& access) {
        if (const auto source = file_column(value_)) {
            for (const Entry& part : value_.entries) {
                if (part.name != "file" && part.name != "column") {
                    reject("unknown key " + part.name, "give file and column only");
                }
            }
            try {
                ValueReader(
                    draft_, key_,
                    {std::string(key_.name), list_of(*source, key_.name, at_), at_})(access);
            } catch (const SignalError& error) {
                reject(error.what(), "name a file and one of its columns");
            }
            return;
        }
        std::vector<double> numbers;
        if (!nonempty_list("numbers")) {
            return;
        }
        for (const Value& element : value_.elements) {
            if (!finite(element) || !in_range(element.number)) {
                continue;
            }
            if (access.ascending && !numbers.empty() && !(numbers.back() < element.number)) {
                reject(fmt::format("must ascend, but {} is not above {}, the value before it",
                                   element.number, numbers.back()),
                       "sort the list and remove repeated values");
                break;
            }
            numbers.push_back(element.number);
        }
        for (double& number : numbers) {
            number *= key_.unit.to_si;
        }
        if (draft_.usable(key_.path())) {
            access.set(draft_.study, numbers);
        }
    }

    void operator()(const TextsAccess& access) {
        std::vector<std::string> texts;
        if (!nonempty_list("strings")) {
            return;
        }
        for (const Value& element : value_.elements) {
            if (element.kind != Value::Kind::text) {
                reject(fmt::format("must be a list of strings, but contains {}", element.shown()),
                       "");
            } else {
                texts.push_back(element.text);
            }
        }
        access.set(draft_.study, texts);
    }

    void operator()(const TablesAccess& access) {
        if (value_.elements.empty() ? is_list(access.elements) : nonempty_list(access.elements)) {
            access.read(draft_.study, value_, rejection());
        }
    }

    void operator()(const PythonAccess& access) {
        if (value_.elements.empty() ? is_list("Python files") : nonempty_list("Python files")) {
            access.set(draft_.study, read_python_features(value_, draft_.runs_python, rejection()));
        }
    }

  private:
    bool finite(const Value& value) {
        std::string what = number_problem(
            value, key_.unit.suffix.empty() ? "" : fmt::format(" in {}", key_.unit.name));
        const bool good = what.empty();
        if (!good) {
            reject(std::move(what), key_.range.hint());
        }
        return good;
    }

    bool in_range(double number) { return check_range(draft_, at_, key_, number); }

    bool is_list(std::string_view of) {
        if (value_.kind == Value::Kind::array) {
            return true;
        }
        reject(fmt::format("must be a list of {}, but is {}", of, value_.shown()),
               "write it in [brackets]");
        return false;
    }

    bool nonempty_list(std::string_view of) {
        if (!is_list(of)) {
            return false;
        }
        if (value_.elements.size() > kMostElements) {
            reject(fmt::format("has {} values, but at most {} are allowed", value_.elements.size(),
                               kMostElements),
                   "give fewer");
            return false;
        }
        if (value_.elements.empty()) {
            reject("is an empty list", "give at least one value, or leave the key out");
            return false;
        }
        return true;
    }

    // Text of the value. A former spelling is replaced, with a notice.
    std::string current_spelling() {
        if (value_.kind != Value::Kind::text) {
            return "";
        }
        const FormerValue* former = former_value(key_.path(), value_.text);
        if (former == nullptr || former->removed) {
            return value_.text;
        }
        draft_.notices.push_back(
            {at_.file, at_.line, key_.path(),
             fmt::format("\"{}\" is the spelling of an earlier version", value_.text),
             fmt::format("write \"{}\"", former->current)});
        return std::string(former->current);
    }

    RejectElement rejection() {
        return [this](const Position& at, std::string what, std::string remedy) {
            draft_.reject(at, key_.path(), std::move(what), std::move(remedy));
        };
    }

    void reject(std::string what, std::string remedy) {
        draft_.reject(at_, key_.path(), std::move(what), std::move(remedy));
    }

    StudyDraft& draft_;
    const Key& key_;
    const Value& value_;
    const Position& at_;
};

}  // namespace

bool check_range(StudyDraft& draft, const Position& at, const Key& key, double number) {
    if (key.range.contains(number)) {
        return true;
    }
    draft.reject(at, key.path(), fmt::format("must be {}, but is {}", key.range.text(), number),
                 "");
    return false;
}

void read_value(StudyDraft& draft, const Key& key, const Entry& entry) {
    draft.given[key.path()] = entry.position;
    std::visit(ValueReader(draft, key, entry), key.access);
}

}  // namespace gearpod::mc
