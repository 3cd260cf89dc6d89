#include "mc/study/rexs/rexs_model.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <pugixml.hpp>
#include <span>
#include <utility>

#include "mc/files/file_descriptor.hpp"
#include "mc/files/input/file_text.hpp"

namespace gearpod::mc {

const RexsAttribute* RexsComponent::find(std::string_view attribute) const {
    const auto at = std::ranges::find_if(attributes, [&](const RexsAttribute& candidate) {
        return candidate.id == attribute && !candidate.text.empty();
    });
    return at == attributes.end() ? nullptr : &*at;
}

std::string RexsRelation::part(std::string_view role) const {
    const auto at =
        std::ranges::find_if(parts, [&](const auto& part) { return part.first == role; });
    return at == parts.end() ? "" : at->second;
}

const RexsComponent* RexsModel::component(std::string_view id) const {
    const auto at = index.find(id);
    return at == index.end() ? nullptr : &components[at->second];
}

std::vector<const RexsComponent*> RexsModel::related(std::string_view relation,
                                                     std::string_view from, std::string_view id,
                                                     std::string_view to) const {
    std::vector<const RexsComponent*> found;
    for (const RexsRelation& candidate : relations) {
        if (candidate.type != relation || candidate.part(from) != id) {
            continue;
        }
        const RexsComponent* part = component(candidate.part(to));
        if (part != nullptr && std::ranges::find(found, part) == found.end()) {
            found.push_back(part);
        }
    }
    return found;
}

void RexsModel::apply(const RexsLoadCase& load_case) {
    for (const RexsComponent& loaded : load_case.components) {
        const auto at = index.find(loaded.id);
        if (at == index.end()) {
            continue;
        }
        std::vector<RexsAttribute>& attributes = components[at->second].attributes;
        for (const RexsAttribute& attribute : loaded.attributes) {
            std::erase_if(attributes, [&](const RexsAttribute& replaced) {
                return replaced.id == attribute.id;
            });
            attributes.push_back(attribute);
        }
    }
}

// Reads REXS files with pugixml. The library neither loads external entities nor expands those that
// a document defines, and it parses without recursion.

namespace {

constexpr off_t kLargestFile = off_t{64} << 20;
constexpr std::ptrdiff_t kMostTags = 2'000'000;
constexpr int kDeepestNesting = 16;  // of elements; a REXS matrix has seven levels

// Line (from 1) of a byte in a text.
class Lines {
  public:
    explicit Lines(const std::string& text) {
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] == '\n') {
                ends_.push_back(static_cast<std::ptrdiff_t>(i));
            }
        }
    }
    int at(std::ptrdiff_t offset) const {
        return offset < 0
                   ? 0
                   : 1 + static_cast<int>(std::ranges::lower_bound(ends_, offset) - ends_.begin());
    }

  private:
    std::vector<std::ptrdiff_t> ends_;
};

// Reason why a text is not XML but another format; empty if it may be XML.
std::string other_format(std::string_view text) {
    const auto starts = [&](std::string_view bytes) { return text.starts_with(bytes); };
    if (starts("PK\x03\x04")) {
        return "is a ZIP archive (.rexsz); unpack it and name the .rexs file in it";
    }
    if (starts("\x1f\x8b")) {
        return "is compressed by gzip; unpack it";
    }
    const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first == std::string_view::npos) {
        return "is empty";
    }
    return text[first] == '{' ? "is JSON; export the model as XML (.rexs)" : "";
}

// True if elements are nested deeper than kDeepestNesting. Visits them without recursion.
bool nested_too_deep(const pugi::xml_node& root) {
    int depth = 0;
    for (pugi::xml_node node = root; node;) {
        if (node.first_child()) {
            node = node.first_child();
            if (++depth > kDeepestNesting) {
                return true;
            }
            continue;
        }
        while (node && !node.next_sibling() && depth > 0) {
            node = node.parent();
            --depth;
        }
        node = depth > 0 ? node.next_sibling() : pugi::xml_node{};
    }
    return false;
}

class Converter {
  public:
    Converter(const std::string& file, const Lines* lines, Problems& problems)
        : file_(file), lines_(lines), problems_(problems) {}

    int line(const pugi::xml_node& node) const {
        return lines_ == nullptr ? 0 : lines_->at(node.offset_debug());
    }
    void reject(int at, const std::string& key, const std::string& what,
                const std::string& remedy = "") {
        constexpr std::size_t kMostProblems = 1000;
        if (problems_.size() < kMostProblems) {
            problems_.push_back({file_, at, key, what, remedy});
        }
    }

    RexsAttribute attribute(const pugi::xml_node& node) const {
        RexsAttribute result{node.attribute("id").value(),
                             std::string(without_outer_blanks(node.attribute("unit").value())),
                             std::string(without_outer_blanks(node.child_value())), true,
                             line(node)};
        if (const pugi::xml_node array = node.child("array")) {
            result.scalar = false;
            result.text = without_outer_blanks(array.child_value("c"));
        } else if (node.child("matrix")) {
            result.scalar = false;
            result.text = "matrix";
        }
        return result;
    }

    RexsComponent component(const pugi::xml_node& node) {
        RexsComponent result{node.attribute("id").value(),
                             node.attribute("type").value(),
                             node.attribute("name").value(),
                             {},
                             line(node)};
        std::map<std::string, const pugi::xml_node> seen;
        for (const pugi::xml_node child : node.children("attribute")) {
            RexsAttribute next = attribute(child);
            const auto [at, is_new] = seen.emplace(next.id, child);
            const RexsAttribute first = attribute(at->second);
            if (is_new) {
                result.attributes.push_back(std::move(next));
            } else if (first.text != next.text || first.unit != next.unit) {
                reject(next.line, result.label() + ": " + next.id,
                       fmt::format("occurs twice, as {} {} and as {} {}", first.text, first.unit,
                                   next.text, next.unit),
                       "keep one of them");
            }
        }
        return result;
    }

    RexsRelation relation(const pugi::xml_node& node) const {
        RexsRelation result{node.attribute("type").value(), {}, line(node)};
        for (const pugi::xml_node ref : node.children("ref")) {
            result.parts.emplace_back(ref.attribute("role").value(), ref.attribute("id").value());
        }
        return result;
    }

    // Makes the index of ids. Rejects an id that occurs twice and relations with components that do
    // not exist.
    void check_ids(RexsModel& model) {
        for (std::size_t i = 0; i < model.components.size(); ++i) {
            const RexsComponent& component = model.components[i];
            if (!model.index.emplace(component.id, i).second) {
                reject(component.line, component.label(), "the id occurs twice",
                       "give every component its own id");
            }
        }
        for (const RexsRelation& relation : model.relations) {
            for (const auto& [role, id] : relation.parts) {
                if (!model.index.contains(id)) {
                    reject(relation.line, "relation " + relation.type,
                           fmt::format("component {} ({}) does not exist", id, role));
                }
            }
        }
    }

    // Rejects versions that this reader does not know; names newer minor ones.
    void check_version(const pugi::xml_node& root, RexsModel& model) {
        model.version = root.attribute("version").value();
        constexpr int kNewest = 6;
        int minor = 0;
        const std::string& text = model.version;
        const bool known = text.starts_with("1.") &&
                           std::from_chars(text.data() + 2, text.data() + text.size(), minor).ptr ==
                               text.data() + text.size() &&
                           text.size() > 2;
        if (!known) {
            reject(line(root), "model",
                   text.empty() ? "states no version"
                                : fmt::format("version {} of REXS is not known", text),
                   "export the model in version 1.0 to 1.6");
        } else if (minor > kNewest) {
            model.notices.push_back(
                {file_, line(root), "model",
                 fmt::format("version {} is newer than 1.{}, the newest that this program knows",
                             text, kNewest),
                 "attributes that were renamed since count as missing"});
        }
    }

  private:
    const std::string& file_;
    const Lines* lines_;
    Problems& problems_;
};

RexsModel converted(const pugi::xml_node& root, Converter& converter, const std::string& name) {
    RexsModel model;
    model.file = name;
    converter.check_version(root, model);
    for (const pugi::xml_node node : root.child("components").children("component")) {
        model.components.push_back(converter.component(node));
    }
    for (const pugi::xml_node node : root.child("relations").children("relation")) {
        model.relations.push_back(converter.relation(node));
    }
    for (const pugi::xml_node spectrum : root.children("load_spectrum")) {
        for (const pugi::xml_node node : spectrum.children("load_case")) {
            RexsLoadCase load_case{node.attribute("id").value(), {}};
            for (const pugi::xml_node component : node.children("component")) {
                load_case.components.push_back(converter.component(component));
            }
            model.load_cases.push_back(std::move(load_case));
        }
    }
    converter.check_ids(model);
    return model;
}

}  // namespace

RexsModel parse_rexs(std::string text, const std::string& name, Problems& problems) {
    const auto refuse = [&](int line, const std::string& what, const std::string& remedy = "") {
        problems.push_back({name, line, "", what, remedy});
        return RexsModel{};
    };
    if (const std::string reason = other_format(text); !reason.empty()) {
        return refuse(0, reason);
    }
    if (std::ranges::count(text, '<') > kMostTags) {
        return refuse(0,
                      fmt::format("has more than {} XML tags, too many for a gear unit", kMostTags),
                      "export the model without meshes and results");
    }
    const Lines lines(text);
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_doctype);
    // Offsets are those of the file only if the text needed no conversion.
    const bool located = result.encoding == pugi::encoding_utf8;
    if (!result) {
        return refuse(located ? lines.at(result.offset) : 0,
                      fmt::format("is not well-formed XML ({})", result.description()));
    }
    for (const pugi::xml_node node : document.children()) {
        if (node.type() == pugi::node_doctype) {
            return refuse(0, "has a document type declaration (DOCTYPE), which REXS does not have",
                          "remove it; entities that it defines are not expanded");
        }
    }
    if (nested_too_deep(document)) {
        return refuse(0, fmt::format("has elements nested more than {} deep", kDeepestNesting));
    }
    const pugi::xml_node root = document.document_element();
    if (std::strcmp(root.name(), "model") != 0) {
        return refuse(located ? lines.at(root.offset_debug()) : 0,
                      fmt::format("is XML, but not REXS: its root is <{}>", root.name()),
                      "a REXS file has the root <model>");
    }
    const std::size_t before = problems.size();
    Converter converter(name, located ? &lines : nullptr, problems);
    RexsModel model = converted(root, converter, name);
    return problems.size() == before ? model : RexsModel{};
}

RexsModel read_rexs(const std::string& path, Problems& problems) {
    const auto refuse = [&](const std::string& what, const std::string& remedy = "") {
        problems.push_back({path, 0, "", what, remedy});
        return RexsModel{};
    };
    // Opening a pipe without O_NONBLOCK waits for a writer.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (file.get() < 0 || ::fstat(file.get(), &status) != 0) {
        return refuse(fmt::format("cannot be read ({})", std::strerror(errno)),
                      "name an existing REXS file (*.rexs)");
    }
    if (!S_ISREG(status.st_mode)) {
        return refuse(S_ISDIR(status.st_mode) ? "is a folder" : "is a device, a pipe or a socket",
                      "name a REXS file (*.rexs)");
    }
    if (status.st_size > kLargestFile) {
        return refuse(fmt::format("has {} MB; models of gear units with up to {} MB are read",
                                  status.st_size >> 20, kLargestFile >> 20),
                      "export the model without meshes and results");
    }
    std::string text(static_cast<std::size_t>(status.st_size), '\0');
    const ssize_t got = read_at(file.get(), std::as_writable_bytes(std::span(text)), 0);
    if (got < 0) {
        return refuse(fmt::format("cannot be read ({})", std::strerror(errno)));
    }
    text.resize(static_cast<std::size_t>(got));
    return parse_rexs(std::move(text), path, problems);
}

}  // namespace gearpod::mc
