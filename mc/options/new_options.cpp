// Options of `new`: the datasheet of a gearbox.

#include "mc/options/options.hpp"

namespace gearpod::mc {

void add_new(CLI::App& app, NewOptions& options, int& code) {
    auto* command = app.add_subcommand("new",
                                       "write a commented study from a gearbox datasheet; missing "
                                       "values follow from rules of thumb with sources");
    PlanetaryDatasheet& data = options.planetary;
    command->add_option("kind", options.kind, "kind of gearbox")
        ->required()
        ->check(CLI::IsMember({"planetary"}));
    command->add_option("--sun", data.sun, "number of teeth of the sun")->required();
    command->add_option("--planet", data.planet, "number of teeth of a planet")->required();
    command->add_option("--ring", data.ring,
                        "number of teeth of the ring (default: sun + 2 planet)");
    command->add_option("--planets", data.planets, "number of planets (default: 3)");
    command->add_option("--module", data.module_mm, "normal module, mm")->required();
    command->add_option("--helix", data.helix_deg, "helix angle, degrees (default: 0)");
    command->add_option("--pressure-angle", data.pressure_angle_deg,
                        "normal pressure angle, degrees (default: 20)");
    command->add_option("--face-width", data.face_width_mm,
                        "face width, mm (default: four circular pitches)");
    command->add_option("--addendum", data.addendum, "addendum divided by the module (default: 1)");
    command->add_option("--sun-shift", data.sun_shift, "profile shift coefficient of the sun");
    command->add_option("--planet-shift", data.planet_shift,
                        "profile shift coefficient of the planets");
    command->add_option("--ring-shift", data.ring_shift,
                        "profile shift coefficient of the ring; positive: thicker teeth (ISO "
                        "21771)");
    command->add_option("--centre-distance", data.centre_distance_mm,
                        "centre distance of sun and planets, mm (default: from the shifts)");
    const std::string tip = "tip circle diameter, mm (default: from addendum and shift)";
    command->add_option("--sun-tip", data.sun_tip_mm, tip);
    command->add_option("--planet-tip", data.planet_tip_mm, tip);
    command->add_option("--ring-tip", data.ring_tip_mm, tip);
    command->add_option("--quality", data.quality, "ISO 1328 grade of the teeth (default: 6)");
    command->add_option("--input", data.input, "driving member (default: sun); the ring is fixed")
        ->check(CLI::IsMember({"sun", "carrier"}));
    command->add_option("--torque", data.torque_N_m, "input torque, N m");
    command->add_option("--speed", data.speed_rpm, "input speed, rpm");
    command->add_option("--power", data.power_kW, "power, kW, instead of torque or speed");
    require_file_name(command->add_option("--out", options.out,
                                          "study file to write (default: - for standard output)"));
    command->add_flag("--force", options.force, "overwrite an existing file");
    command->callback([command, &options, &code] {
        options.command = "new " + options.kind;
        for (const CLI::Option* option : command->parse_order()) {
            if (option->nonpositional() && !option->check_lname("out") &&
                !option->check_lname("force")) {
                options.command += " " + option->get_name() + " " + option->results().front();
            }
        }
        code = new_command(options);
    });
}

}  // namespace gearpod::mc
