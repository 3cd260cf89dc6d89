// Checks every kind of fault: names shown to the user, keys, and the law that its study builds.
#include "mc/plan/scene.hpp"
#include "mc/study/faults/crack.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/schema/sizes.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study/find_fault.hpp"
#include "tests/mc/study_example.hpp"

namespace gearpod::mc::test_faults {

using namespace tests;
using namespace gearpod::test;

// Keys of each kind on a tooth of the example's sun, with the largest describable size.
struct Example {
    const char *kind, *keys;
};
const Example kExamples[] = {
    {"crack", "depth_mm = 3"},
    {"spatial-crack",
     "stage = 2\ngrowth_depth_mm = [1, 2]\ngrowth_end_depth_mm = [0, 1]\n"
     "growth_length_mm = [20, 38.1]\ngrowth_height_mm = [0.5, 0.5]\n"
     "growth_end_height_mm = [1, 1]"},
    {"chip", "chip_mm = 8"},
    {"breakage", "break_width_mm = 10\nbreak_height_mm = 3"},
    {"pitting",
     "pit_width_mm = 10\npit_length_mm = 1\npit_radius_mm = 30.5\npit_depth_mm = 0.2\nteeth = 2"},
    {"wear", "wear_um = 20\n[effects]\ncontact_onset = \"extended\""},
    {"broken", "broken = 0.5"},
    {"reduction", "reduction = 0.3"},
};

const char* keys_of(const FaultKind& kind) {
    const auto* found = std::find_if(std::begin(kExamples), std::end(kExamples),
                                     [&](const Example& e) { return e.kind == kind.name(); });
    INFO(kind.name() << " has no example");
    REQUIRE(found != std::end(kExamples));
    return found->keys;
}

std::string text_with(const FaultKind& kind) {
    const std::string fault = "[fault]\nkind = \"" + std::string(kind.name()) +
                              "\"\nmember = \"sun\"\n" + keys_of(kind) + "\n";
    const std::string text = replaced(
        kExampleStudy, "[fault]\nkind = \"crack\"\nmember = \"planet\"\nside = \"ring\"\n", fault);
    return replaced(
        text, "fault.depth_mm = { distribution = \"levels\", values = [0, 1, 2, 3, 4.3] }\n", "");
}

Study study_with(const FaultKind& kind) {
    const StudyReading reading = read_study_text(text_with(kind), "fault.toml");
    INFO(format(reading.problems));
    REQUIRE(reading.study);
    return *reading.study;
}

// Problems of the text with `from` replaced by `to`.
std::string problems_of(const std::string& text, const std::string& from, const std::string& to) {
    return format(read_study_text(replaced(text, from, to), "fault.toml").problems);
}

TEST_CASE("Every kind of fault has its own name, words and size") {
    std::set<std::string_view> names{"none"}, words, sizes;
    for (const FaultKind* kind : all_faults()) {
        INFO(kind->name());
        CHECK(find_fault(kind->name()) == kind);
        CHECK(names.insert(kind->name()).second);
        CHECK(words.insert(kind->words()).second);
        CHECK(sizes.insert(kind->size().name).second);
        CHECK_FALSE(kind->words().empty());
        CHECK_FALSE(kind->title().empty());
    }
    CHECK(find_fault("none") == nullptr);
    CHECK(std::size(kExamples) == all_faults().size());
}

TEST_CASE("Every key of a kind of fault is one of the schema, its size the only random one") {
    for (const FaultKind* kind : all_faults()) {
        const Study study = study_with(*kind);
        for (const FaultKey& fault_key : kind->keys()) {
            INFO(kind->name() << " " << fault_key.name);
            const Key* const key = find_key("fault", fault_key.name);
            REQUIRE(key != nullptr);
            CHECK(key->doc == fault_key.doc);
            CHECK(key->presence(study).need == fault_key.need);
            CHECK((key->unit.suffix.empty() || key->name.ends_with(key->unit.suffix)));
            CHECK(key->may_be_random() == (fault_key.name == kind->size().name));
            const std::string owner = "\"" + std::string(kind->name()) + "\"";
            for (const FaultKind* other : all_faults()) {
                const Presence presence = key->presence(study_with(*other));
                CHECK((presence.need != Need::forbidden || contains(presence.why, owner)));
            }
        }
    }
}

TEST_CASE("The size of every kind of fault is one key, one unit and one column") {
    for (const FaultKind* kind : all_faults()) {
        INFO(kind->name());
        Study study = study_with(*kind);
        CHECK(fault_size_key(study).name == kind->size().name);
        CHECK(fault_size_key(study).unit.si_name == detection_request(study).size.unit);
        CHECK(fault_size_column(study) ==
              "fault_" + std::string(fault_size_key(study).stem()) +
                  (fault_size_key(study).unit.si_suffix.empty() ? "" : "_m"));
        const double size = fault_size(study);
        CHECK(size > 0.0);
        CHECK(size_groups(study).front().high == size);
        const Study same = study;
        set_fault_size(study, 0.5 * size);
        CHECK(fault_size(study) == 0.5 * size);
        CHECK(fault_size(same) == size);
        CHECK_FALSE(study == same);
        CHECK(*read_study_text(resolved_text(same), "resolved.toml").study == same);
    }
}

TEST_CASE("Every kind of fault but wear weakens the tooth of a study's gearbox") {
    for (const FaultKind* kind : all_faults()) {
        INFO(kind->name());
        const Study study = study_with(*kind);
        const Scene scene(study);
        CHECK(scene.gearbox().fault().worn_pairs().empty() != kind->wears_flanks());
        if (kind->wears_flanks()) {
            CHECK(scene.gearbox().fault().curves() == 0);
            CHECK(scene.gearbox().fault().mesh(0, fault_size(study)) == nullptr);
            continue;
        }
        CHECK(scene.gearbox().fault().curves() == 1);
        CHECK(scene.gearbox().fault().largest_size() >= fault_size(study));
        const auto faulty = scene.gearbox().fault().mesh(0, fault_size(study));
        REQUIRE(faulty != nullptr);
        const auto& healthy = *scene.gearbox().stiffness->meshes()[0].stiffness;
        double least = 1.0;
        for (int i = 0; i < 100; ++i) {
            const double tau = healthy.contact_ratio() * i / 100;
            least = std::min(
                least, total_at(*faulty, healthy.transitions(), tau) / total_at(healthy, tau));
        }
        CHECK(least < 1.0);
        CHECK(scene.gearbox().fault().mesh(0, 0.0) == nullptr);
    }
}

TEST_CASE("Text about a fault names its kind and its size") {
    const Folder folder;
    for (const FaultKind* kind : all_faults()) {
        const std::string text = text_with(*kind), words(kind->words());
        const std::string path = folder.file(std::string(kind->name()) + ".toml");
        write_bytes(path, text);
        check_mentions(require_success("describe " + path + " --seconds 0.1"),
                       {std::string(kind->title()) + " on the sun", "fault origin"});

        const std::string name = "fault.kind = \"" + std::string(kind->name()) + "\"",
                          size = std::string(kind->size().name);
        const FaultKind& other = *find_fault(kind->name() == "broken" ? "reduction" : "broken");
        const std::string misplaced =
            problems_of(text_with(other), "[fault]\n", "[fault]\n" + size + " = 0\n");
        CHECK(contains(misplaced, "fault." + size + ": is not allowed"));
        CHECK(contains(misplaced, "only for " + name));
        const std::string without_member = problems_of(text, "member = \"sun\"\n", "");
        CHECK(contains(without_member,
                       "missing (fault.kind is \"" + std::string(kind->name()) + "\")"));

        const std::string both =
            problems_of(text, "member = \"sun\"", "member = \"planet\"\nside = \"both\"");
        CHECK(contains(both, words + " is on one flank") == kind->on_one_flank());
    }
}

TEST_CASE("A partly broken planet tooth weakens the meshes of both its flanks") {
    const std::string text = replaced(text_with(*find_fault("breakage")), "member = \"sun\"",
                                      "member = \"planet\"\nside = \"both\"");
    const StudyReading reading = read_study_text(text, "fault.toml");
    INFO(format(reading.problems));
    REQUIRE(reading.study);
    CHECK(Scene(*reading.study).gearbox().fault().curves() == 2);
    const std::string wide = problems_of(text, "break_width_mm = 10", "break_width_mm = 40");
    CHECK(contains(wide, "fault.break_width_mm"));
    CHECK(contains(wide, "wider than the face"));
}

TEST_CASE("Wear needs extended contact, a depth within the tooth, and no life") {
    const std::string text = text_with(*find_fault("wear"));
    const std::string abrupt = problems_of(text, "\"extended\"", "\"abrupt\"");
    CHECK(contains(abrupt, "fault.kind"));
    CHECK(contains(abrupt, "contact_onset = \"extended\""));
    const std::string negative = problems_of(text, "wear_um = 20", "wear_um = -1");
    CHECK(contains(negative, "fault.wear_um"));
    CHECK(contains(negative, "must be >= 0, but is -1"));
    const std::string deep = problems_of(text, "wear_um = 20", "wear_um = 6000");
    CHECK(contains(deep, "fault.wear_um"));
    CHECK(contains(deep, "4987.28 um thick"));  // half of a pitch of 3.175 mm times pi
    const std::string lives = problems_of(text, "[sensor]", "[life]\ninterval_h = 10\n[sensor]");
    CHECK(contains(lives, "life.interval_h"));
    CHECK(contains(lives, "the fault is not a crack"));
    CHECK(contains(problems_of(text, "kind = \"planetary\"\n",
                               "kind = \"planetary\"\ntooth_profile = \"constant\"\n"),
                   "wear needs the shape of its tooth"));
}

TEST_CASE("Cracks follow the law given by the study, by default that of its tooth profile") {
    const auto law = [](const std::string& profile, const std::string& key) {
        std::string text = replaced(text_with(*find_fault("crack")), "[gearbox]\n",
                                    "[gearbox]\ntooth_profile = \"" + profile + "\"\n");
        text = replaced(text, "[fault]\n", "[fault]\n" + key);
        const StudyReading reading = read_study_text(text, "fault.toml");
        INFO(format(reading.problems));
        REQUIRE(reading.study);
        return crack_law(*reading.study);
    };
    using gearpod::stiffness::CrackLaw;
    CHECK(law("fillet", "") == CrackLaw::fracture_mechanics);
    CHECK(law("root-circle", "") == CrackLaw::sections);
    CHECK(law("base-circle", "") == CrackLaw::sections);
    for (const char* profile : {"fillet", "root-circle", "base-circle"}) {
        CHECK(law(profile, "crack_law = \"sections\"\n") == CrackLaw::sections);
        CHECK(law(profile, "crack_law = \"fracture-mechanics\"\n") == CrackLaw::fracture_mechanics);
    }
    const std::string wrong = problems_of(text_with(*find_fault("crack")), "[fault]\n",
                                          "[fault]\ncrack_law = \"beams\"\n");
    CHECK(contains(wrong, "fault.crack_law"));
    CHECK(contains(wrong, "fracture-mechanics"));
}

TEST_CASE("A crack's fraction of the critical section is reported") {
    const Study study = study_with(*find_fault("crack"));
    const double largest = max_crack_depth_m(study);
    const double sizes[] = {0.25 * largest, 0.5 * largest};
    const std::string origin = find_fault("crack")->origin(study, sizes);
    INFO(origin);
    CHECK(contains(origin, "root circle"));
    CHECK(contains(origin, "mm is 25, 50 % of that section"));
}

}  // namespace gearpod::mc::test_faults
