#include "engine/formats/read_bytes.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "engine/formats/shape_file.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

class ReadBytesTest : public testing::Test {
 protected:
  ReadBytesTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("fjord-read-" + std::to_string(getpid()) + "-" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~ReadBytesTest() override { std::filesystem::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& bytes) {
    const std::string path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  const std::filesystem::path folder_;
};

TEST_F(ReadBytesTest, ReadsAllBytes) {
  std::string bytes(3'000'001, 'x');
  bytes[7] = '\0';
  EXPECT_EQ(ReadBytes(Write("a b", bytes), bytes.size()).value(), bytes);
  EXPECT_EQ(ReadBytes(Write("empty", ""), 10).value(), "");
}

TEST_F(ReadBytesTest, SaysWhatIsWrong) {
  const std::string missing = folder_ / "none.std";
  ExpectError(ReadBytes(missing, 10), missing, "no such file");
  EXPECT_EQ(ReadBytes(missing, 10).error().code, ErrorCode::kNotFound);
  ExpectError(ReadBytes(folder_, 10), folder_, "is a folder");
  const std::string long_one = Write("long", "12345678901");
  ExpectError(ReadBytes(long_one, 10), long_one, "has 11 bytes; at most 10 are read");
  EXPECT_EQ(ReadBytes(long_one, 10).error().code, ErrorCode::kLimit);
  ExpectError(ReadBytes("/dev/zero", 100'000), "/dev/zero", "is a device");
}

// A pipe that never ends: refused at the bound, with no more than that in memory.
TEST_F(ReadBytesTest, EndlessPipesStopAtTheBound) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string block(1 << 16, 'x');
    close(ends[0]);
    while (write(ends[1], block.data(), block.size()) > 0) {
    }
    _exit(0);
  }
  close(ends[1]);
  const std::string path = "/dev/fd/" + std::to_string(ends[0]);
  ExpectError(ReadBytes(path, 20'000'000), path, "more than 20000000 bytes");
  close(ends[0]);
  EXPECT_EQ(waitpid(child, nullptr, 0), child) << "the writer ends with its pipe";
}

TEST_F(ReadBytesTest, PipesThatEndAreRead) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string block(3'000'001, 'x');
    for (size_t sent = 0; sent < block.size();) {
      sent += static_cast<size_t>(write(ends[1], block.data() + sent, block.size() - sent));
    }
    _exit(0);
  }
  close(ends[1]);
  const auto bytes = ReadBytes("/dev/fd/" + std::to_string(ends[0]), 4'000'000);
  ASSERT_TRUE(bytes.ok());
  EXPECT_EQ(*bytes, std::string(3'000'001, 'x'));
  close(ends[0]);
  waitpid(child, nullptr, 0);
}

// Two gigabytes that take no space on the disk.
TEST_F(ReadBytesTest, HugeFilesAreRefusedWithoutReadingThem) {
  const std::string path = Write("huge.std", "data 3 1\n");
  std::filesystem::resize_file(path, uint64_t{2} << 30);
  const auto shape = ReadShapeFile(path);
  ExpectError(shape, path, "at most");
}

TEST_F(ReadBytesTest, ShapesByPath) {
  EXPECT_TRUE(ReadShapeFile(Write("t.std", "data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n")));
}

}  // namespace
}  // namespace fjord
