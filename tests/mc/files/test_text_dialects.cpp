// Checks that text tables of all usual forms have the same values, or are refused with the reason.
#include "mc/files/text/text_table.hpp"
#include "tests/mc/files/recorded.hpp"

namespace gearpod::test_text_dialects {

using namespace test;

const std::vector<double> kTime{0, 0.25, 0.5, 0.75}, kSensor{2.5, -1.125, 1024, 0.5};

struct Files {
    Folder folder;

    std::string written(const std::string& text, const std::string& name = "a.csv") const {
        return file_with(folder, name, text);
    }
    std::unique_ptr<mc::SignalFile> opened(const std::string& text) const {
        return mc::open_signal_file(written(text));
    }
    // Message about reading a column.
    std::string refusal(const std::string& text, const std::string& column = "sensor",
                        const std::string& name = "a.csv") const {
        const std::string path = written(text, name);
        return error_in([&] {
            const auto file = mc::open_signal_file(path);
            if (file->find({column}).empty()) {
                throw mc::SignalError("no column");
            }
            static_cast<void>(file->read(column));
        });
    }
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
    return text;
}

std::string utf16(const std::string& ascii, bool big) {
    std::string bytes = big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : ascii) {
        bytes += big ? std::string{'\0', c} : std::string{c, '\0'};
    }
    return bytes;
}

const std::string kPlain = "time [s],sensor [g]\n0,2.5\n0.25,-1.125\n0.5,1024\n0.75,0.5\n";
const std::string kSemicolons = "time [s];sensor [g]\n0;2,5\n0,25;-1,125\n0,5;1024\n0,75;0,5\n";
const std::string kTabs = replaced(kPlain, ",", "\t");

TEST_CASE("a signal is the same in every form of a text table") {
    const Files files;
    const std::pair<const char*, std::string> forms[] = {
        {"plain", kPlain},
        {"semicolons and decimal commas", kSemicolons},
        {"tabs", kTabs},
        {"tabs and decimal commas", replaced(replaced(kPlain, ",", "\t"), ".", ",")},
        {"blanks", "time sensor[g]\n0 2.5\n 0.25  -1.125\n0.5\t1024\n0.75   0.5\n"},
        {"a stated separator", "sep=;\n" + kSemicolons},
        {"a quoted stated separator", "\"sep=;\"\r\n" + kSemicolons},
        {"a separator after each value", replaced(kSemicolons, "\n", ";\n")},
        {"a tab after each value", replaced(kTabs, "\n", "\t\n")},
        {"a separator after the values only",
         "time [s],sensor [g]\n0,2.5,\n0.25,-1.125,\n0.5,1024,\n0.75,0.5,\n"},
        {"empty columns of a spreadsheet", replaced(kPlain, "\n", ",,,\n") + ",,,,\n,,,,\n"},
        {"quotation marks",
         "\"time [s]\",\"sensor [g]\"\n\"0\",\"2.5\"\n\"0.25\",\"-1.125\"\n\"0.5\",\"1024\"\n"
         "\"0.75\",\"0.5\"\n"},
        {"quoted decimal commas",
         "time [s],sensor [g]\n0,\"2,5\"\n\"0,25\",\"-1,125\"\n\"0,5\",1024\n\"0,75\",\"0,5\"\n"},
        {"row numbers of pandas",
         ",time [s],sensor [g]\n0,0,2.5\n1,0.25,-1.125\n2,0.5,1024\n3,0.75,0.5\n"},
        {"row numbers that were read and written again",
         "Unnamed: 0,time [s],sensor [g]\n0,0,2.5\n1,0.25,-1.125\n2,0.5,1024\n3,0.75,0.5\n"},
        {"row names of R",
         "\"\",\"time [s]\",\"sensor [g]\"\n\"1\",0,2.5\n\"2\",0.25,-1.125\n\"3\",0.5,1024\n"
         "\"4\",0.75,0.5\n"},
        {"row names of R without a header",
         "\"time [s]\",\"sensor [g]\"\n\"1\",0,2.5\n\"2\",0.25,-1.125\n\"3\",0.5,1024\n"
         "\"4\",0.75,0.5\n"},
        {"a line of units", "time,sensor\ns,g\n0,2.5\n0.25,-1.125\n0.5,1024\n0.75,0.5\n"},
        {"a line of units in brackets", "time\tsensor\t\n[s]\t[g]\t\n" + kTabs.substr(20)},
        {"lines about the recorder", "Recorder X, 2 channels\nRate: 4\n\n" + kPlain},
        {"lines of two fields about the recorder", "Title:\trig 2\nRate\t4\nChannels\t2\n" + kTabs},
        {"comments", "# by a recorder\n\n" + replaced(kPlain, "0.5,1024", "# gap?\n0.5,1024")},
        {"names in a comment", "# from numpy\n# time [s],sensor [g]\n" + kPlain.substr(20)},
        {"names in a comment, blanks",
         "# time [s] sensor [g]\n0 2.5\n0.25 -1.125\n0.5 1024\n"
         "0.75 0.5\n"},
        {"CR LF", replaced(kPlain, "\n", "\r\n")},
        {"CR", replaced(kPlain, "\n", "\r")},
        {"no end of the last line", kPlain.substr(0, kPlain.size() - 1)},
        {"a byte order mark", "\xEF\xBB\xBF" + kPlain},
        {"UTF-16, little endian", utf16(replaced(kSemicolons, "\n", "\r\n"), false)},
        {"UTF-16, big endian", utf16(kPlain, true)},
        {"a text column",
         "label,time [s],sensor [g]\na;b,0,2.5\n\"x, \"\"y\"\"\",0.25,-1.125\n"
         ",0.5,1024\nNA,0.75,0.5\n"},
        {"a column with gaps",
         "time [s],sensor [g],rpm\n0,2.5,\n0.25,-1.125,NaN\n0.5,1024,12\n"
         "0.75,0.5,--\n"},
        {"time stamps, as text and as times",
         "stamp;Time;sensor [g]\n2024-03-01 12:00:00;2024-03-01T12:00:00Z;2.5\n"
         "x;2024-03-01T12:00:00.25Z;-1.125\nx;2024-03-01T12:00:00.500Z;1024\n"
         "x;2024-03-01T12:00:00.750000Z;0.5\n"},
        {"two other columns of one name",
         "x,x,time [s],sensor [g]\n1,2,0,2.5\n1,2,0.25,-1.125\n"
         "1,2,0.5,1024\n1,2,0.75,0.5\n"},
        {"a name of two lines",
         "\"time\n[s]\",\"sensor\r\n[g]\"\n0,2.5\n0.25,-1.125\n0.5,1024\n"
         "0.75,0.5\n"},
        {"plus signs and exponents",
         "time [s],sensor [g]\n0,+2.5E+0\n2.5e-1,-1.125\n"
         "+0.5,1.024E3\n0.75,5e-1\n"},
    };
    for (const auto& [form, text] : forms) {
        INFO(form);
        std::unique_ptr<mc::SignalFile> file;
        REQUIRE_NOTHROW(file = files.opened(text));
        CHECK(file->read(file->find({"time"})) == kTime);
        CHECK(file->read("sensor") == kSensor);
        CHECK(file->unit("sensor") == "g");
    }
}

TEST_CASE("one column may have decimal commas") {
    const Files files;
    for (const char* text :
         {"sensor [g]\n2,5\n-1,125\n1024,0\n0,5\n", "sensor [g]\n2,5\n-1,125\n1024\n0,5\n",
          "Recorder X\n\nsensor\ng\n2,5\n-1,125\n1024,0\n0,5\n",
          "\"sensor [g]\"\r\n2,5\r\n-1,125\r\n1024,0\r\n0,5\r\n"}) {
        INFO(text);
        const auto file = files.opened(text);
        REQUIRE(file->names() == std::vector<std::string>{"sensor"});
        CHECK(file->read("sensor") == kSensor);
        CHECK(file->unit("sensor") == "g");
    }
}

TEST_CASE("a table may be compressed with gzip, and bombs and truncated files are refused") {
    const Files files;
    const auto compressed = [&](const std::string& text, const std::string& name) {
        const std::string path = files.folder.file(name);
        REQUIRE(std::system(("gzip < " + files.written(text) + " > " + path).c_str()) == 0);
        return path;
    };
    for (const char* name : {"a.csv.gz", "a.txt.gz", "A.CSV.GZ"}) {
        INFO(name);
        CHECK(mc::open_signal_file(compressed(kPlain, name))->read("sensor") == kSensor);
    }
    CHECK(mc::read_text_table(compressed(kPlain, "t.csv.gz")).rows.size() == 4);
    std::string rows = kPlain;
    for (int i = 0; i < 1000; ++i) {
        rows += std::to_string(i) + "," + std::to_string(i * i % 997) + "\n";
    }
    std::string bytes = bytes_of(compressed(rows, "long.csv.gz"));
    CHECK_THAT(files.refusal(bytes.substr(0, bytes.size() / 2), "sensor", "cut.csv.gz"),
               Catch::Contains("truncated"));
    bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
    CHECK_THAT(files.refusal(bytes, "sensor", "bad.csv.gz"), Catch::Contains("damaged"));
    std::string bomb = "sensor\n";
    while (bomb.size() < std::size_t{100} << 20) {
        bomb += std::string(100000, '0') + "\n";
    }
    CHECK_THAT(files.refusal(bytes_of(compressed(bomb, "bomb.csv.gz")), "sensor", "b.csv.gz"),
               Catch::Contains("MB of text"));
    CHECK_THAT(files.refusal("x", "sensor", "a.h5.gz"), Catch::Contains("gunzip"));
}

TEST_CASE("columns are selected by their names, also with remarks in parentheses") {
    const Files files;
    const auto file = files.opened(
        "time (s),Accelerometer (rear),Acc (left) [g],Acc (right) [g],\"sensor, rear\",Kraft / N,"
        "channel (1),u[V (rms)]\n0,1,2,3,4,5,6,7\n1,1,2,3,4,5,6,7\n");
    CHECK(file->unit("time") == "s");
    CHECK(file->read("Accelerometer (rear)") == std::vector<double>{1, 1});
    CHECK(file->read("Accelerometer") == std::vector<double>{1, 1});
    CHECK(file->unit("Accelerometer") == "");
    CHECK(file->unit("Acc (right)") == "g");
    CHECK(file->read("Acc (right) [g]") == std::vector<double>{3, 3});
    CHECK(file->find({"Acc"}) == "");
    CHECK(file->find({"Accelerometer"}) == "Accelerometer (rear)");
    CHECK(file->read("sensor, rear") == std::vector<double>{4, 4});
    CHECK(file->unit("Kraft") == "N");
    CHECK(file->unit("channel (1)") == "");
    CHECK(file->unit("u") == "V (rms)");
}

TEST_CASE("no statement in brackets is dropped") {
    const std::tuple<const char*, const char*, const char*> headers[] = {
        {"sensor[g (peak)]", "sensor", "g (peak)"},
        {"sensor [g (peak)]", "sensor", "g (peak)"},
        {"sensor [m/s^2]", "sensor", "m/s^2"},
        {"sensor [parsec]", "sensor", "parsec"},
        {"sensor(m/s^2)", "sensor", "m/s^2"},
        {"sensor (g (peak))", "sensor", "g (peak)"},
        {"time [s] (rel)", "time (rel)", "s"},
        {"sensor [g] filtered", "sensor filtered", "g"},
        {"[g] sensor", "sensor", "g"},
        {"acc[0] [g]", "acc[0]", "g"},
        {"Accelerometer (rear) (g)", "Accelerometer (rear)", "g"},
        {"Accelerometer (rear)", "Accelerometer (rear)", ""},
        {"sensor [g", "sensor [g", ""},
        {"sensor [[g]]", "sensor", "[g]"},
        {"a / g", "a", "g"},
        {"in / out", "in / out", ""},
        {"[0]", "[0]", ""}};
    for (const auto& [header, name, unit] : headers) {
        INFO(header);
        CHECK(mc::column_of(header).name == name);
        CHECK(mc::column_of(header).unit == unit);
    }
}

TEST_CASE("the reason why a table is refused is named with its line") {
    constexpr const char* kNoThousands = "with a decimal point and without thousands separators";
    const Files files;
    const std::pair<std::string, const char*> cases[] = {
        {"time,sensor\n0,1\n1,one\n2,3\n", "a.csv:3: column sensor: \"one\" is not a number"},
        {"time,sensor\n0,1\n1,\n2,3\n3,NA\n",
         "a.csv:3: column sensor: is empty; 2 of 4 samples have no value"},
        {"time,sensor\n0,1\n1,NA\n2,3\n", "a.csv:3: column sensor: is \"NA\"; 1 of 3"},
        {"time;sensor\n0;1.234,5\n1;2.345,5\n", kNoThousands},
        {"time,sensor\n0,\"1,234.5\"\n1,\"2,345.5\"\n", kNoThousands},
        {"time;sensor\n0;1'234\n1;1'235\n", kNoThousands},
        {"time,sensor\n0,\"1,234\"\n1,\"2,345\"\n", "a.csv:2: column sensor: \"1,234\" is not"},
        {"time;sensor\n0.25;1,234\n0.5;2,345\n", kNoThousands},
        {"time;sensor\n0;999\n1;1,001\n", "a.csv:3: column sensor: \"1,001\" is not a number"},
        {"time;sensor\n0;1,5\n1;2.5\n", kNoThousands},
        {"time,sensor\n0,1\n1\n2,3\n", "a.csv:3: 1 values, but the header names 2 columns"},
        {"time,sensor\n0,1\n1,2,3\n2,3\n", "a.csv:3: 3 values, but the header names 2 columns"},
        {"time,sensor\n0,\"1\n1,2\n2,3\n", "a.csv:2: a quotation mark is not closed"},
        {"sensor,sensor\n0,1\n1,2\n", "two columns are named sensor"},
        {"time,sensor [g]\ns,m/s^2\n0,1\n1,2\n", "but the line before states g"},
        {std::string("t\0i\0m\0e\0\n\0", 10), "is not a line of text (UTF-16"},
        {"PK\x03\x04more", "is not a file that gearpod reads"},
        {"# nothing\n\n", "is empty"}};
    for (const auto& [text, reason] : cases) {
        INFO(text);
        CHECK_THAT(files.refusal(text), Catch::Contains(reason));
    }
}

TEST_CASE("names in Latin-1 are read as UTF-8") {
    const Files files;
    const auto file = files.opened("Zeit [s];K\xF6rperschall [m/s\xB2]\n0;1,5\n1;2,5\n");
    REQUIRE(file->names() == std::vector<std::string>{"Zeit", "Körperschall"});
    CHECK(file->unit("Körperschall") == "m/s²");
    const mc::TextTable table = mc::read_text_table(
        files.written("file;gearbox\na.csv;M\xFChle\nb.csv;\"say \"\"x\"\"\"\n"));
    CHECK(table.rows[0][1] == "Mühle");
    CHECK(table.rows[1][1] == "say \"x\"");
}

TEST_CASE("a table of text keeps all its rows, whatever is in them") {
    const Files files;
    const mc::TextTable table = mc::read_text_table(
        files.written(",file,label,torque [N m]\n0,a.csv,healthy,\"1,5\"\n1,\"b, c.csv\",,2\n"
                      "2,d.csv,NA,-3\n"));
    REQUIRE(table.rows.size() == 3);
    CHECK(table.names() == "file, label, torque");
    CHECK(table.rows[1][*table.find("file")] == "b, c.csv");
    CHECK(table.number(0, *table.find("torque")) == 1.5);
    CHECK(table.lines == std::vector<long>{2, 3, 4});
    CHECK(mc::read_text_table(files.written("file\na.csv\nb c.csv\n")).rows.size() == 2);
    CHECK(mc::read_text_table(files.written("file,label\n")).rows.empty());
}

TEST_CASE("a text that begins like a formula is escaped in CSV") {
    CHECK(mc::csv_field("=1+2") == "'=1+2");
    CHECK(mc::csv_field("@sum(a,b)") == "\"'@sum(a,b)\"");
    CHECK(mc::csv_field("\t=1") == "'\t=1");
    CHECK(mc::csv_field("-rear") == "'-rear");
    CHECK(mc::csv_field("+A1") == "'+A1");
    CHECK(mc::csv_field("-12.5") == "-12.5");
    CHECK(mc::csv_field("a=b") == "a=b");
    CHECK(mc::csv_field("a \"b\"") == "\"a \"\"b\"\"\"");
}

}  // namespace gearpod::test_text_dialects
