#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "attack.hpp"
#include "dice.hpp"
#include "mutation.hpp"
#include "tests/mc/edited_results.hpp"

namespace gearpod::test {
namespace {

namespace fs = std::filesystem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kNumbers{0.0,       -0.0,       1.0,    -1.0, 0.5,   2.0,   1e-9,   1e-30,
                              1e-300,    1e9,        1e18,   1e19, 1e150, 1e300, -1e300, kNan,
                              kInfinity, -kInfinity, 5e-324, 4.0,  1e6,   -20.0, 1e12,   3.0};

void write(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// Bytes with flipped bits, replaced numbers, and stretches cleared, copied, cut off or inserted.
std::string damaged(std::string bytes, Dice& dice) {
    const std::size_t times = 1 + dice.below(6);
    for (std::size_t i = 0; i < times && bytes.size() > 16; ++i) {
        const std::size_t at = dice.below(bytes.size() - 8);
        const std::size_t length = 1 + dice.below(std::min<std::size_t>(64, bytes.size() - at - 1));
        const double number = dice.one_of(kNumbers);
        switch (dice.below(8)) {
            case 0:
                std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length,
                            static_cast<char>(dice.below(2) == 0 ? 0 : 255));
                break;
            case 1:
                std::memcpy(bytes.data() + at / 8 * 8, &number, 8);
                break;
            case 2:
                bytes.replace(at, length, bytes, dice.below(bytes.size() - length), length);
                break;
            case 3:
                bytes.resize(dice.below(4) == 0 ? at : bytes.size());
                break;
            case 4:
                bytes.insert(at, length, static_cast<char>(dice.below(256)));
                break;
            default:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
        }
    }
    return bytes;
}

// Replaces numbers of a dataset, or changes their count.
void exchange(hid_t root, const std::string& name, Dice& dice) {
    mc::Numbers numbers = mc::read_numbers(root, name, std::size_t{1} << 24);
    if (dice.below(3) == 0) {
        numbers.shape[0] = dice.below(2) == 0 ? dice.below(5) : numbers.shape[0] * 3;
        std::size_t count = 1;
        for (const hsize_t extent : numbers.shape) {
            count *= extent;
        }
        numbers.values.resize(count, 1.0);
    }
    for (std::size_t i = 0; i < 1 + dice.below(4) && !numbers.values.empty(); ++i) {
        numbers.values[dice.below(numbers.values.size())] = dice.one_of(kNumbers);
    }
    replace_numbers(root, name, numbers.shape, numbers.values);
}

void edit(hid_t root, const Arsenal& arsenal, std::uint64_t number, Dice& dice) {
    constexpr std::array kGroups{"instances", "features", "timing", "."};
    switch (dice.below(4)) {
        case 0: {
            const std::string study = mutated(arsenal.studies, number);
            mc::check(H5Adelete(root, "study"), "study");
            mc::write_text(root, ".", "study", study);
            break;
        }
        case 1:
            exchange(root, "noise_levels", dice);
            break;
        case 2: {
            const std::string group = dice.one_of(kGroups);
            const mc::Hdf5Handle open = mc::open_group(root, group);
            const auto names = mc::link_names(open.get());
            const std::string name = dice.one_of(names);
            mc::check(H5Ldelete(open.get(), name.c_str(), H5P_DEFAULT), name);
            break;
        }
        default: {
            const mc::Hdf5Handle open =
                mc::open_group(root, dice.below(2) == 0 ? "instances" : "features");
            const auto names = mc::link_names(open.get());
            const std::string name = dice.one_of(names);
            if (name != "group") {
                const std::string unit = mc::read_text(open.get(), name, "unit");
                exchange(open.get(), name, dice);
                mc::write_text(open.get(), name, "unit", unit);
            }
        }
    }
}

// The same table as other programs write it: other separators, decimal commas, units, missing
// values, quotes, preambles, index columns and encodings, any of them wrong now and then.
std::string in_dialect(const std::string& table, Dice& dice) {
    constexpr std::array kPreambles{"sep=;\n", "# made by\n", "\xEF\xBB\xBF", "Recorder;7\n\n",
                                    "\n\n"};
    constexpr std::array kUnits{
        " [g (peak)]", " (m/s**2)",      " [mV]", " [\xB5m]", " [r/min]", " []",
        " [m/s\xB2]",  " [kg m/s^2/kg]", " [[g]", " [sec]",   ""};
    constexpr std::array kMissing{"NA",   "NaN", "",        "-",  "null",
                                  "#N/A", "1,5", "1.234,5", "1e", "inf"};
    constexpr std::array kSeparators{",", ";", "\t", " ", ", ", "|"};
    constexpr std::array kEnds{"\n", "\r\n", "\r", ",\n", ";\n"};
    const std::string separator = dice.one_of(kSeparators), end = dice.one_of(kEnds);
    const bool comma = dice.below(3) == 0, quoted = dice.below(4) == 0, index = dice.below(4) == 0;
    std::string out = dice.below(3) == 0 ? dice.one_of(kPreambles) : "";
    std::size_t line = 0;
    std::string field;
    const auto put = [&] {
        if (line == 0 && dice.below(3) == 0) {
            field = field.substr(0, field.find(" [")) + dice.one_of(kUnits);
        } else if (line > 0 && dice.below(500) == 0) {
            field = dice.one_of(kMissing);
        }
        if (comma && line > 0) {
            std::replace(field.begin(), field.end(), '.', ',');
        }
        out += quoted ? '"' + field + '"' : field;
        field.clear();
    };
    for (const char c : table) {
        if (c == ',') {
            put();
            out += separator;
        } else if (c == '\n') {
            put();
            out += end;
            ++line;
            if (index) {
                out += std::to_string(line) + separator;
            }
        } else {
            field += c;
        }
    }
    if (dice.below(8) == 0) {  // UTF-16
        std::string wide = "\xFF\xFE";
        for (const char c : out) {
            wide += {c, '\0'};
        }
        return wide;
    }
    return dice.below(4) == 0 ? damaged(out, dice) : out;
}

// Rows of numbers, some of them hostile, with a sampling rate and a speed that may be hostile, too.
std::string hostile_csv(Dice& dice) {
    constexpr std::array kColumns{"time", "mesh_phase", "speed_rpm", "sensor", "te"};
    constexpr std::array kNames{"time", "te", "sensor", "mesh_phase", "speed_rpm", "", "1", "x"};
    std::vector<std::string> names;
    for (const char* column : kColumns) {
        if (dice.below(3) != 0) {
            names.emplace_back(dice.below(30) == 0 ? dice.one_of(kNames) : column);
        }
    }
    const std::size_t rows = dice.below(4) == 0 ? dice.below(20) : 200 + dice.below(8000);
    const double step = std::pow(10.0, -1.0 - static_cast<double>(dice.below(4)));
    const double speed = dice.below(3) == 0 ? dice.one_of(kNumbers) : 60.0;
    const double size = dice.below(3) == 0 ? dice.one_of(kNumbers) : 1e-3;
    const std::size_t odd = dice.below(4) == 0 ? dice.below(rows + 1) : rows;
    std::string text;
    for (std::size_t c = 0; c < names.size(); ++c) {
        text += (c == 0 ? "" : ",") + names[c];
    }
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t c = 0; c < names.size(); ++c) {
            const bool clock = names[c] == "time" || names[c] == "mesh_phase";
            double value = clock ? step * static_cast<double>(row)
                           : names[c] == "speed_rpm"
                               ? speed
                               : size * std::sin(0.7 * static_cast<double>(row));
            value = row == odd ? dice.one_of(kNumbers) : value;
            std::array<char, 32> number{};
            std::snprintf(number.data(), number.size(), "%.9g", value);
            text += (c == 0 ? "\n" : ",") + std::string(number.data());
        }
    }
    return text + "\n";
}

}  // namespace

Attack attack_by_study(const Arsenal& arsenal, const std::string& folder, std::uint64_t number) {
    Dice dice(number);
    const std::string path = folder + "/s.toml";
    write(path, mutated(arsenal.studies, number));
    switch (dice.below(4)) {
        case 0:
            return {{"stiffness", path}, false};
        case 1:
            return {{"modes", path}, true};
        default:
            return {{"describe", path}, false};
    }
}

Attack attack_by_results(const Arsenal& arsenal, const std::string& folder, std::uint64_t number) {
    Dice dice(number);
    const std::string path = folder + "/r.h5", genuine = folder + "/genuine.h5";
    write(path, arsenal.results);
    write(genuine, arsenal.results);
    switch (dice.below(4)) {
        case 0:
            write(path, damaged(arsenal.results, dice));
            break;
        case 1:
            edit_results(path, [&](hid_t root) { edit(root, arsenal, number, dice); });
            break;
        default: {  // changed bytes under a valid checksum
            std::string bytes = arsenal.results;
            for (std::size_t i = 0; i < 1 + dice.below(4); ++i) {
                constexpr std::size_t kUserBlock = 512;
                // Most of what describes the data lies in the first part.
                const std::size_t most = dice.below(2) == 0 ? 8192 : bytes.size() - kUserBlock;
                bytes[kUserBlock + dice.below(std::min(most, bytes.size() - kUserBlock))] =
                    static_cast<char>(dice.below(256));
            }
            write(path, bytes);
            update_checksum(path);
        }
    }
    const std::vector<std::vector<std::string>> commands{
        {"run", arsenal.small_study, "--instances", "5", "--resume", "--quiet", "--out", path},
        {"report", path, "--html", folder + "/r.html"},
        {"report", path, "--by", "torque_N_m"},
        {"compare", genuine, path},
        {"merge", path, "--out", folder + "/m.h5"},
        {"repair", path},
        {"report", path, "--dataset", folder + "/dataset"},
        {"misses", path, "--feature", "te_rms", "--size", "1", "--quiet", "--gearboxes", "2",
         "--records", "2"},
        {"rare", path, "--feature", "te_rms", "--rate", "0.1", "--quiet", "--gearboxes", "2"}};
    switch (dice.below(4)) {
        case 0:  // the output quotes the mutated study
            return {{"report", path, "--json", "-"}, false, {genuine}};
        case 1:
            return {{"-c",
                     "import sys; sys.path.insert(0, sys.argv[1]); import gearpod\n"
                     "try: r = gearpod.open(sys.argv[2]); [r.feature(f) for f in r.features]\n"
                     "except (ValueError, OSError, KeyError) as e: print(sys.argv[2], e); exit(2)",
                     GEARPOD_SOURCE_DIR "/analysis/python", path},
                    false,
                    {genuine},
                    "/usr/bin/python3"};
        default:
            return {dice.one_of(commands), false, {genuine}};
    }
}

Attack attack_by_checkpoint(const Arsenal& arsenal, const std::string& folder,
                            std::uint64_t number) {
    Dice dice(number);
    const std::string path = folder + "/r.h5";
    write(path + ".part", damaged(arsenal.checkpoint, dice));
    return {{"run", arsenal.small_study, "--instances", "200000", "--time-limit", "00:00:01",
             "--resume", "--quiet", "--out", path}};
}

Attack attack_by_signal(const Arsenal& arsenal, const std::string& folder, std::uint64_t number) {
    Dice dice(number);
    const std::array<std::pair<const char*, const std::string*>, 5> genuine{
        {{"/x.h5", &arsenal.hdf5},
         {"/x.wav", &arsenal.wav},
         {"/x.uff", &arsenal.uff},
         {"/x.tdms", &arsenal.tdms},
         {"/x.csv", &arsenal.csv}}};
    const std::size_t kind = dice.below(12);
    const std::string path = folder + (kind < 5 ? genuine[kind].first : "/x.csv");
    write(path, kind < 5   ? damaged(*genuine[kind].second, dice)
                : kind < 8 ? hostile_csv(dice)
                           : in_dialect(arsenal.csv, dice));
    Attack attack{{"features", path, "--study", arsenal.small_study}};
    if (dice.below(2) == 0) {
        attack.arguments.insert(attack.arguments.end(), {"--json", "-"});
    }
    if (dice.below(8) == 0) {
        attack.arguments.insert(attack.arguments.end(), {"--healthy", path});
    }
    if (dice.below(6) == 0) {
        constexpr std::array kRates{"1e-300", "1", "50", "5000", "1e18", "1e300", "nan", "inf"};
        attack.arguments.insert(attack.arguments.end(),
                                {"--sampling-Hz", std::string(dice.one_of(kRates))});
    }
    return attack;
}

// Tables of inspections, and lists of recordings, some of which exist.
Attack attack_by_table(const Arsenal& arsenal, const std::string& folder, std::uint64_t number) {
    Dice dice(number);
    const std::string path = folder + "/t.csv";
    if (dice.below(3) != 0) {
        constexpr std::array kOptions{"--link=logit",       "--link=probit", "--link=cloglog",
                                      "--link=loglog",      "--bounds=wald", "--size-scale=log",
                                      "--size-scale=linear"};
        const std::string& table = dice.one_of(arsenal.inspections);
        write(path, dice.below(2) == 0 ? damaged(table, dice) : in_dialect(table, dice));
        Attack attack{{"pod", path, "--json", "-"}, false};  // the output quotes the table's names
        for (std::size_t i = 0; i < dice.below(3); ++i) {
            attack.arguments.emplace_back(dice.one_of(kOptions));
        }
        return attack;
    }
    write(folder + "/a.csv", arsenal.csv);
    write(folder + "/b.csv", hostile_csv(dice));
    write(path, damaged("file,gearbox,time,label,size [mm],load\n"
                        "a.csv,one,1,healthy,0,100\nb.csv,one,2,faulty,1.5,110\n"
                        "a.csv,two,3,healthy,0,90\nc.csv,two,4,,,95\n",
                        dice));
    return {{"features", "--manifest", path, "--study", arsenal.small_study, "--quiet", "--out",
             folder + "/f.h5"},
            false};
}

Attack attack_by_rexs(const Arsenal& arsenal, const std::string& folder, std::uint64_t number) {
    constexpr std::array kValues{"0",   "1",    "-1",  "1e300", "nan", "true", "9999999", "0.001",
                                 "1,5", "none", "mum", "deg",   "",    "-8.4", "20 28",   "&#x1;"};
    Dice dice(number);
    std::string model = dice.one_of(arsenal.gear_units);
    for (std::size_t i = 0; i < 1 + dice.below(3); ++i) {
        const std::size_t from =
            model.find(dice.below(3) == 0 ? '"' : '>', dice.below(model.size()));
        const std::size_t to = model.find_first_of("\"<", std::min(from, model.size() - 1) + 1);
        if (to != std::string::npos) {
            model.replace(from + 1, to - from - 1, dice.one_of(kValues));
        }
    }
    const std::string path = folder + "/m.rexs";
    write(path, dice.below(4) == 0 ? damaged(model, dice) : model);
    Attack attack{{"new", "--rexs", path}, false, {path}};
    constexpr std::array kOptions{"--torque=100", "--speed=1000", "--addendum=1", "--stage=1",
                                  "--stage=2",    "--shaft=50",   "--quality=6"};
    for (std::size_t i = 0; i < dice.below(4); ++i) {
        attack.arguments.emplace_back(dice.one_of(kOptions));
    }
    return attack;
}

// The same file in two roles, by name or by link.
Attack attack_by_roles(const Arsenal& arsenal, const std::string& folder, std::uint64_t number) {
    Dice dice(number);
    const std::string study = folder + "/s.toml", results = folder + "/r.h5",
                      signal = folder + "/x.csv", link = folder + "/link";
    fs::copy_file(arsenal.small_study, study);
    write(results, arsenal.results);
    write(signal, arsenal.csv);
    const std::array files{study, results, signal};
    const std::string& aim = dice.one_of(files);
    std::string name = aim;
    if (dice.below(3) != 0) {
        dice.below(2) == 0 ? fs::create_symlink(aim, link) : fs::create_hard_link(aim, link);
        name = link;
    }
    switch (dice.below(6)) {
        case 0:
            return {{"run", study, "--quiet", "--out", name}, true, {study}};
        case 1:
            return {{"report", results, "--json", name}, true, {results}};
        case 2:
            return {{"report", results, "--html", name}, true, {results}};
        case 3:
            return {{"stiffness", study, "--csv", name}, false, {study}};
        case 4:
            return {{"modes", study, "--json", name}, true, {study}};
        default:
            return {{"features", signal, "--study", study, "--json", name}, true, {study, signal}};
    }
}

}  // namespace gearpod::test
