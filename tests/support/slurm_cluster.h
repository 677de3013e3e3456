// A cluster of Slurm on this machine for a test: real daemons with a munge key, ports and folders of their
// own, without systemd, cgroups or accounting. One node, on which four tasks run at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/child_process.h"

namespace osteomill::testing {

class SlurmCluster {
  public:
    /// Empty if a cluster can run; else the missing part.
    static std::string why_not();

    /// Starts the daemons in `folder`, which is there, and waits until the node takes work. Throws
    /// std::runtime_error if it does not.
    explicit SlurmCluster(std::filesystem::path folder);
    ~SlurmCluster();
    SlurmCluster(const SlurmCluster&) = delete;
    SlurmCluster& operator=(const SlurmCluster&) = delete;

    /// sbatch with these variables ("OUT=x") and words; the job's number. Throws std::runtime_error with its
    /// message if it refuses.
    std::string submit(const std::vector<std::string>& variables, const std::vector<std::string>& words) const;
    /// Tasks of a job that wait or run, such as "7_2"; none once it has ended.
    std::vector<std::string> tasks(const std::string& job) const;
    void cancel(const std::string& task) const;

  private:
    Finished run(const std::vector<std::string>& command) const;

    std::filesystem::path folder_;
    std::vector<std::unique_ptr<ChildProcess>> daemons_;
};

}  // namespace osteomill::testing
