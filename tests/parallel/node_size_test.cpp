#include "parallel/node_size.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/scratch.hpp"

namespace freestand::parallel::node_size_test {
namespace {

class NodeSizeTest : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  double memory() const { return memory_for_this_process(root_.folder()); }

  freestand::test::Scratch root_{"node_size"};
  const double machine_ = memory();  // where nothing limits it
};

TEST_F(NodeSizeTest, IsThatOfTheMachineWhereNothingLimitsIt) {
  EXPECT_GT(machine_, 1e8);
  write("proc/self/cgroup", "4:memory:/a\n0::/b\n");
  EXPECT_EQ(memory(), machine_);
  write("sys/fs/cgroup/b/memory.max", "max\n");
  write("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(memory(), machine_);
}

TEST_F(NodeSizeTest, IsTheLeastOfTheGroupsAboveOfVersion2) {
  write("proc/self/cgroup", "0::/system.slice/job_7/step_0\n");
  write("sys/fs/cgroup/system.slice/job_7/step_0/memory.max", "max\n");
  write("sys/fs/cgroup/system.slice/job_7/memory.max", "4000000\n");
  write("sys/fs/cgroup/system.slice/memory.max", "5000000\n");
  EXPECT_EQ(memory(), 4e6);
}

TEST_F(NodeSizeTest, IsThatOfVersion1BesideOtherControllers) {
  write("proc/self/cgroup", "5:cpu,cpuacct:/other\n4:hugetlb,memory:/slurm/job_7\n0::/\n");
  write("sys/fs/cgroup/memory/slurm/job_7/memory.limit_in_bytes", "3000000\n");
  write("sys/fs/cgroup/memory/other/memory.limit_in_bytes", "1000000\n");
  EXPECT_EQ(memory(), 3e6);
}

// A container that sees its own group as the uppermost, under a name that is that of the machine around it.
TEST_F(NodeSizeTest, IsThatOfTheContainer) {
  write("proc/self/cgroup", "0::/docker/0123\n");
  write("sys/fs/cgroup/memory.max", "2000000\n");
  EXPECT_EQ(memory(), 2e6);
}

TEST_F(NodeSizeTest, OfOneRankIsItsOwn) {
  const NodeSize node = narrowest_node({});
  EXPECT_EQ(node.ranks, 1);
  EXPECT_EQ(node.memory_bytes, memory_for_this_process());
}

}  // namespace
}  // namespace freestand::parallel::node_size_test
