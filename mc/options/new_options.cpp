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
    add_number(*command, "--sun", data.sun, "number of teeth of the sun")->required();
    add_number(*command, "--planet", data.planet, "number of teeth of a planet")->required();
    add_number(*command, "--ring", data.ring,
               "number of teeth of the ring (default: sun + 2 planet)");
    add_number(*command, "--planets", data.planets, "number of planets (default: 3)");
    add_number(*command, "--module", data.module_mm, "normal module, mm")->required();
    add_number(*command, "--helix", data.helix_deg, "helix angle, degrees (default: 0)");
    add_number(*command, "--pressure-angle", data.pressure_angle_deg,
               "normal pressure angle, degrees (default: 20)");
    add_number(*command, "--face-width", data.face_width_mm,
               "face width, mm (default: four circular pitches)");
    add_number(*command, "--addendum", data.addendum,
               "addendum divided by the module (default: 1)");
    add_number(*command, "--sun-shift", data.sun_shift, "profile shift coefficient of the sun");
    add_number(*command, "--planet-shift", data.planet_shift,
               "profile shift coefficient of the planets");
    add_number(*command, "--ring-shift", data.ring_shift,
               "profile shift coefficient of the ring; positive: thicker teeth (ISO "
               "21771)");
    add_number(*command, "--centre-distance", data.centre_distance_mm,
               "centre distance of sun and planets, mm (default: from the shifts)");
    const std::string tip = "tip circle diameter, mm (default: from addendum and shift)";
    add_number(*command, "--sun-tip", data.sun_tip_mm, tip);
    add_number(*command, "--planet-tip", data.planet_tip_mm, tip);
    add_number(*command, "--ring-tip", data.ring_tip_mm, tip);
    add_number(*command, "--quality", data.quality, "ISO 1328 grade of the teeth (default: 6)");
    command->add_option("--input", data.input, "driving member (default: sun); the ring is fixed")
        ->check(CLI::IsMember({"sun", "carrier"}));
    add_number(*command, "--torque", data.torque_N_m, "input torque, N m");
    add_number(*command, "--speed", data.speed_rpm, "input speed, rpm");
    add_number(*command, "--power", data.power_kW, "power, kW, instead of torque or speed");
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
