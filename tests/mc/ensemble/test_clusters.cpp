// Checks what cluster users meet: launchers whose processes MPI does not connect, memory limits of
// jobs, and elements of a job array that are submitted again.
#include "mc/ensemble/ranks.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_clusters {

using namespace test;

TEST_CASE("Processes that a launcher started and MPI does not connect are refused") {
    const Folder folder;
    const std::string run = std::string(GEARPOD_PROGRAM) + " run " +
                            study("planet-crack-ideal.toml") + " --quiet --out " +
                            folder.file("r.h5");
    const std::string remedy = mc::Ranks::built_with_mpi()
                                   ? "MPI connects only 1: use srun --mpi=pmix"
                                   : "-DGEARPOD_MPI=ON";
    check_refused(shell("SLURM_PROCID=1 SLURM_STEP_NUM_TASKS=3 " + run),
                  {"srun started 3 processes (SLURM_STEP_NUM_TASKS)", remedy});
    check_refused(shell("PMI_RANK=0 PMI_SIZE=4 " + run),
                  {"started 4 processes (PMI_SIZE)", remedy});
    for (const char* rank : {"PMI_RANK=3", "SLURM_NTASKS=3 SLURM_PROCID=1", "MPI_LOCALNRANKS=4",
                             "SLURM_STEP_NUM_TASKS=4294967297"}) {
        INFO(rank);
        check_refused(shell(std::string(rank) + " " + run), {" processes (", remedy});
    }
    CHECK(folder.empty());
}

TEST_CASE("The processes of mpirun are connected, also within a step of srun", "[mpi]") {
    const auto code = [](int ranks) {
        const Folder folder;
        return shell("export SLURM_STEP_NUM_TASKS=5; " + mpirun(ranks) + GEARPOD_PROGRAM + " run " +
                     study("planet-crack-ideal.toml") +
                     " --quiet --instances 8 --set ensemble.threshold_instances=8"
                     " --set numerics.threads=1 --out " +
                     folder.file("r.h5"))
            .code;
    };
    CHECK(code(2) == 0);
}

TEST_CASE("A job may use what the tightest of its control groups leaves") {
    const Folder folder;
    const std::filesystem::path mounted = folder.path();
    const auto write = [&](const std::string& name, const std::string& text) {
        std::filesystem::create_directories((mounted / name).parent_path());
        write_bytes((mounted / name).string(), text);
    };
    const auto left = [&](const std::string& groups) {
        std::istringstream stream(groups);
        return mc::left_in_control_groups(stream, mounted);
    };
    CHECK(left("0::/\n") == std::numeric_limits<double>::infinity());
    write("job/memory.max", "4000\n");
    write("job/memory.current", "1000\n");
    write("job/step/memory.max", "max\n");
    write("job/step/task/memory.max", "3500\n");
    write("job/step/task/memory.current", "400\n");
    CHECK(left("0::/job/step/task\n") == 3000.0);
    CHECK(left("0::/job/step/other/not/visible\n") == 3000.0);
    // Cached files are given back.
    write("job/step/task/memory.stat", "anon 100\ninactive_file 300\n");
    CHECK(left("0::/job/step/task\n") == 3000.0);
    write("job/memory.stat", "inactive_file 250\n");
    CHECK(left("0::/job/step/task\n") == 3250.0);
    write("memory/slurm/job/memory.limit_in_bytes", "900\n");
    write("memory/slurm/job/memory.usage_in_bytes", "100\n");
    CHECK(left("12:cpuset:/slurm/job\n5:hugetlb,memory:/slurm/job/step\n0::/job/step\n") == 800.0);
    CHECK(left("12:cpuset:/slurm/job\nmisplaced\n") == std::numeric_limits<double>::infinity());
}

TEST_CASE("Elements of an array that are submitted again keep their parts") {
    const Folder folder;
    for (const std::string name : {"sbatch", "program"}) {
        write_bytes(folder.file(name), "#!/bin/sh\necho \"" + name + " $*\"\n");
        std::filesystem::permissions(folder.file(name), std::filesystem::perms(0755));
    }
    const auto element = [&](int id, int of, int first, const std::string& more = "") {
        return shell("cd " + folder.path() + "; export PATH=$PWD:$PATH GEARPOD=program " + more +
                     " SLURM_ARRAY_JOB_ID=9 SLURM_CPUS_PER_TASK=1 SLURM_ARRAY_TASK_ID=" +
                     std::to_string(id) + " SLURM_ARRAY_TASK_COUNT=" + std::to_string(of) +
                     " SLURM_ARRAY_TASK_MIN=" + std::to_string(first) + "; sh " +
                     study("slurm-array.sh") + " a.toml out");
    };
    // Without the number of all parts, some elements are refused.
    check_refused(element(2, 2, 2), {"GEARPOD_PARTS must state"});
    CHECK(element(2, 2, 2, "GEARPOD_PARTS=3").mentions("--part 2/3"));
    const Outcome first = element(1, 3, 1);
    CHECK(first.mentions("--part 1/3"));
    CHECK(first.mentions("merge 'out.1.h5' 'out.2.h5' 'out.3.h5' --out 'out.h5'"));
    for (const int id : {2, 3}) {  // sbatch --array=2,3
        const Outcome again = element(id, 2, 2);
        CHECK(again.mentions("--part " + std::to_string(id) + "/3"));
        CHECK(again.mentions("'out.1.h5' 'out.2.h5' 'out.3.h5'") == (id == 2));
    }
    check_refused(element(4, 4, 1), {"element 4 of 3 parts"});
    check_refused(element(0, 1, 0), {"element 0 of 3 parts"});
    CHECK(element(1, 1, 1).mentions("--part 1/3"));
    check_refused(element(1, 1, 1, "GEARPOD_PARTS=5"), {"GEARPOD_PARTS is 5, but out.parts has 3"});
    check_refused(element(1, 1, 1, "GEARPOD_PARTS=abc"), {"\"abc\" is not a number of parts"});
}

}  // namespace gearpod::test_clusters
