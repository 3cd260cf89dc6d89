// REXS models for tests: a planetary stage of 20/28/76 teeth with three planets, and a gear pair of
// 23/67 teeth, written attribute by attribute so that tests can change any of them.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gearpod::test {

class RexsExample {
  public:
    std::string version = "1.4";
    // Attributes by component id; each as {unit, text}.
    std::map<int, std::map<std::string, std::pair<std::string, std::string>>> attributes;
    std::map<int, std::string> types;
    // Relation type with roles and component ids.
    std::vector<std::pair<std::string, std::vector<std::pair<std::string, int>>>> relations;
    std::string load_spectrum, prologue;

    void add(int id, const std::string& type) { types[id] = type; }
    void set(int id, const std::string& name, const std::string& unit, const std::string& text) {
        attributes[id][name] = {unit, text};
    }
    void relate(const std::string& type, std::vector<std::pair<std::string, int>> parts) {
        relations.emplace_back(type, std::move(parts));
    }

    std::string text() const {
        std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + prologue +
                          "<model version=\"" + version +
                          "\" applicationId=\"test\" applicationVersion=\"1\" date=\"\">\n"
                          "<relations>\n";
        int number = 0;
        for (const auto& [type, parts] : relations) {
            xml += "<relation id=\"" + std::to_string(++number) + "\" type=\"" + type + "\">";
            for (const auto& [role, id] : parts) {
                xml += "<ref id=\"" + std::to_string(id) + "\" role=\"" + role + "\"/>";
            }
            xml += "</relation>\n";
        }
        xml += "</relations>\n<components>\n";
        for (const auto& [id, type] : types) {
            xml += "<component id=\"" + std::to_string(id) + "\" type=\"" + type + "\">\n";
            const auto at = attributes.find(id);
            if (at != attributes.end()) {
                for (const auto& [name, value] : at->second) {
                    xml += "<attribute id=\"" + name + "\" unit=\"" + value.first + "\">" +
                           value.second + "</attribute>\n";
                }
            }
            xml += "</component>\n";
        }
        return xml + "</components>\n" + load_spectrum + "</model>\n";
    }

    void add_gear(int id, const std::string& type, int shaft, int teeth, double module_mm) {
        add(id, type);
        set(id, "number_of_teeth", "none", std::to_string(teeth));
        set(id, "normal_module", "mm", std::to_string(module_mm));
        set(id, "face_width", "mm", "20");
        set(id, "normal_pressure_angle", "deg", "20");
        relate("assembly", {{"assembly", shaft}, {"part", id}});
        relate("reference", {{"origin", id}, {"referenced", 90}});
    }
};

// Component ids: stage 1, sun 10, ring 11, planets 21 to 23, their pairs with sun 31 to 33 and ring
// 41 to 43, shafts of sun 50, ring 51 and carrier 52, planets 61 to 63 and pins 71 to 73, load 80,
// steel 90, casing 2.
inline RexsExample planetary_example() {
    RexsExample m;
    m.add(1, "planetary_stage");
    m.add(2, "gear_casing");
    for (const int shaft : {50, 51, 52, 61, 62, 63, 71, 72, 73}) {
        m.add(shaft, "shaft");
    }
    m.add(90, "material");
    m.set(90, "elastic_modulus", "N / mm^2", "210000");
    m.set(90, "poisson_ratio", "none", "0.29");
    m.add_gear(10, "cylindrical_gear", 50, 20, 2);
    m.add_gear(11, "ring_gear", 51, 76, 2);
    m.relate("central_shaft", {{"planetary_stage", 1}, {"shaft", 50}});
    m.relate("central_shaft", {{"planetary_stage", 1}, {"shaft", 51}});
    m.relate("planet_carrier_shaft", {{"planetary_stage", 1}, {"shaft", 52}});
    for (int i = 1; i <= 3; ++i) {
        m.add_gear(20 + i, "cylindrical_gear", 60 + i, 28, 2);
        for (const auto& [pair, first, second] :
             {std::tuple{30 + i, 10, 20 + i}, std::tuple{40 + i, 20 + i, 11}}) {
            m.add(pair, "cylindrical_stage");
            m.set(pair, "center_distance", "mm", "48");
            m.set(pair, "rotating_angle_around_neg_u_axis", "deg", std::to_string(120 * i));
            m.relate("assembly", {{"assembly", 1}, {"part", pair}});
            m.relate("stage", {{"stage", pair}, {"gear_1", first}, {"gear_2", second}});
        }
        m.add(100 + i, "concept_bearing");
        m.set(100 + i, "radial_stiffness", "N / m", "2.5e8");
        m.relate("side", {{"outer_part", 60 + i}, {"inner_part", 70 + i}, {"assembly", 100 + i}});
        m.relate("planet_shaft", {{"planetary_stage", 1}, {"shaft", 60 + i}});
        m.relate("planet_pin", {{"planetary_stage", 1}, {"shaft", 70 + i}});
    }
    m.set(50, "rotational_speed", "1 / min", "1500");
    m.set(50, "defines_speed", "none", "true");
    m.add(80, "external_load");
    m.set(80, "torque_around_u_axis", "N m", "30.5");
    m.set(80, "defines_torque", "none", "true");
    m.relate("assembly", {{"assembly", 50}, {"part", 80}});
    return m;
}

// Component ids: stages 1 (gears 10 and 11) and 2 (gears 12 and 13), shafts 50 to 52, load 80,
// steel
// 90. Stage 1 reduces 23 to 67 teeth at 53 mm; stage 2 reduces 20 to 76 teeth.
inline RexsExample two_pairs_example() {
    RexsExample m;
    for (const int shaft : {50, 51, 52}) {
        m.add(shaft, "shaft");
    }
    m.add(90, "material");
    m.set(90, "elastic_modulus", "N / mm^2", "206000");
    m.add_gear(10, "cylindrical_gear", 50, 23, 1);
    m.add_gear(11, "cylindrical_gear", 51, 67, 1);
    m.add_gear(12, "cylindrical_gear", 51, 20, 1.5);
    m.add_gear(13, "cylindrical_gear", 52, 76, 1.5);
    m.set(10, "helix_angle_reference_diameter", "deg", "30");
    m.set(11, "helix_angle_reference_diameter", "deg", "-30");
    for (const int stage : {1, 2}) {
        m.add(stage, "cylindrical_stage");
        m.relate("stage", {{"stage", stage}, {"gear_1", 8 + 2 * stage}, {"gear_2", 9 + 2 * stage}});
    }
    m.set(1, "center_distance", "mm", "53");
    m.set(2, "center_distance", "mm", "72");
    m.set(50, "rotational_speed", "1 / min", "1400");
    m.add(80, "external_load");
    m.set(80, "torque_around_u_axis", "N m", "4.7");
    m.set(80, "defines_torque", "none", "true");
    m.relate("assembly", {{"assembly", 50}, {"part", 80}});
    return m;
}

}  // namespace gearpod::test
