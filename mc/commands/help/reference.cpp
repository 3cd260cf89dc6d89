#include "mc/commands/help/reference.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "features/feature.hpp"
#include "mc/study/distributions/distribution.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// Escapes text for roff: backslashes, hyphens, and a dot or quote at the start of a line.
std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return !out.empty() && (out[0] == '.' || out[0] == '\'') ? "\\&" + out : out;
}

std::vector<const CLI::App*> commands(const CLI::App& app) {
    return app.get_subcommands(
        [](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> options(const CLI::App& app) {
    return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

void add_option(std::string& out, const CLI::Option& option) {
    out += ".TP\n.B " + roff(option.get_name(option.get_positional(), true));
    if (takes_value(option) && !option.get_positional()) {
        out += " \\fI" + roff(option.get_type_name()) + "\\fR";
    }
    out += "\n" + roff(option.get_description()) + "\n";
}

// Choices of an option, taken from the name of its check, "IN:{a,b}".
std::vector<std::string> choices(const CLI::Option& option) {
    std::vector<std::string> names;
    const std::string type = option.get_type_name();
    const std::size_t open = type.find('{'), close = type.find('}');
    if (open == std::string::npos || close == std::string::npos) {
        return names;
    }
    return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

std::string words(const CLI::App& app) {
    std::string text;
    for (const CLI::Option* option : options(app)) {
        for (const std::string& name : option->get_lnames()) {
            text += " --" + name;
        }
        for (const std::string& name : option->get_snames()) {
            text += " -" + name;
        }
    }
    return text.empty() ? text : text.substr(1);
}

using OrderedJson = nlohmann::ordered_json;

OrderedJson option_json(const CLI::Option* option) {
    return {{"name", option->get_name(option->get_positional(), true)},
            {"positional", option->get_positional()},
            {"required", option->get_required()},
            {"type", takes_value(*option) ? option->get_type_name() : std::string()},
            {"several", option->get_items_expected_max() > 1},
            {"meaning", option->get_description()}};
}

template <class Elements, class Function>
OrderedJson list_json(const Elements& elements, Function json_of) {
    OrderedJson list = OrderedJson::array();
    for (const auto& element : elements) {
        list.push_back(json_of(element));
    }
    return list;
}

OrderedJson command_json(const CLI::App* command) {
    return {{"name", command->get_name()},
            {"meaning", command->get_description()},
            {"options", list_json(options(*command), option_json)}};
}

OrderedJson distribution_json(const DistributionHelp& distribution) {
    return {{"name", distribution.name}, {"parameters", distribution.parameters}};
}

OrderedJson feature_json(const features::Feature& feature) {
    const char* compared[] = {"nothing", "change", "baseline", "change"};
    return {{"name", feature.name},
            {"title", feature.title},
            {"unit", feature.unit},
            {"alarm", analysis::alarm_name(feature.alarm)},
            {"basic", feature.basic()},
            {"from_sensor", feature.from_sensor},
            {"compared", compared[static_cast<int>(feature.baseline_use)]},
            {"definition", feature.doc}};
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version) {
    std::string out = ".TH GEARPOD 1 \"\" \"" + roff(version) + "\" \"User Commands\"\n" +
                      ".SH NAME\ngearpod \\- probability of detection of gear faults\n" +
                      ".SH SYNOPSIS\n.B gearpod\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n" +
                      ".SH DESCRIPTION\n" + roff(app.get_description()) + "\n.SH OPTIONS\n";
    for (const CLI::Option* option : options(app)) {
        add_option(out, *option);
    }
    out += ".SH COMMANDS\n";
    for (const CLI::App* command : commands(app)) {
        out += ".SS gearpod " + roff(command->get_name()) + "\n" +
               roff(command->get_description()) + "\n";
        for (const CLI::Option* option : options(*command)) {
            add_option(out, *option);
        }
    }
    return out +
           ".SH EXIT STATUS\n.TP\n0\nsuccess\n.TP\n2\nwrong input, or an output that cannot be "
           "written; every problem is printed\n"
           ".TP\n3\nsome gearboxes failed; they are counted, and the results are written\n"
           ".TP\n4\nstopped before the end; \\-\\-resume continues from the checkpoint\n";
}

std::string bash_completion(const CLI::App& app) {
    std::string names, cases, values;
    for (const CLI::App* command : commands(app)) {
        names += (names.empty() ? "" : " ") + command->get_name();
        cases +=
            fmt::format("        {}) options=\"{}\" ;;\n", command->get_name(), words(*command));
        for (const CLI::Option* option : options(*command)) {
            const auto choice = choices(*option);
            for (const std::string& name :
                 choice.empty() ? std::vector<std::string>() : option->get_lnames()) {
                values += fmt::format("        {}:--{}) choices=\"{}\" ;;\n", command->get_name(),
                                      name, fmt::join(choice, " "));
            }
        }
    }
    return "# Bash completion of gearpod, generated from its command line.\n"
           "_gearpod() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} options= choices=\n"
           "    COMPREPLY=()\n"
           "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
           "        mapfile -t COMPREPLY < <(compgen -W \"" +
           names + " " + words(app) +
           "\" -- \"$word\")\n"
           "        return\n"
           "    fi\n"
           "    case $command:${COMP_WORDS[COMP_CWORD - 1]} in\n" +
           values +
           "    esac\n"
           "    case $command in\n" +
           cases +
           "    esac\n"
           "    if [ -n \"$choices\" ]; then\n"
           "        mapfile -t COMPREPLY < <(compgen -W \"$choices\" -- \"$word\")\n"
           "    elif [ \"${word#-}\" != \"$word\" ]; then\n"
           "        mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
           "    else\n"
           "        mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
           "    fi\n"
           "}\n"
           "complete -o filenames -F _gearpod gearpod ./gearpod\n";
}

std::string reference_json(const CLI::App& app, const std::string& version) {
    OrderedJson json = OrderedJson::object();
    json["program"] = app.get_description();
    json["version"] = version;
    json["commands"] = list_json(commands(app), command_json);
    json["exit_codes"] = {
        {"0", "done"},
        {"2", "bad input, or an output that cannot be written; every problem is reported"},
        {"3", "some gearboxes failed; they are counted, and the results are written"},
        {"4", "stopped before the end, with a checkpoint from which --resume continues"}};
    json["sections"] = section_names();
    json["keys"] = list_json(schema(), key_json);
    json["distributions"] = list_json(distribution_help(), distribution_json);
    json["features"] = list_json(features::all_features(), feature_json);
    return json.dump(1) + "\n";
}

}  // namespace gearpod::mc
