#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <system_error>
#include <thread>

#include "mesh/child_process.h"
#include "mesh/mesh_readers.h"
#include "mesh_file.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::AllOf;
using testing::HasSubstr;

int signalOf(const ChildResult& child) { return WIFSIGNALED(child.status) ? WTERMSIG(child.status) : 0; }

TEST(ChildProcess, GetsItsInputAndGivesItsOutput) {
  const std::string input(200000, 'x');  // more than a pipe holds
  const ChildResult child = runChild("/bin/sh", {"-c", "cat; cat <&0; exit 7"}, input);
  EXPECT_EQ(child.output, input);
  ASSERT_TRUE(WIFEXITED(child.status));
  EXPECT_EQ(WEXITSTATUS(child.status), 7);
}

TEST(ChildProcess, MayDieBeforeItReads) {
  EXPECT_EQ(signalOf(runChild("/bin/sh", {"-c", "kill -SEGV $$"}, std::string(200000, 'x'))), SIGSEGV);
}

TEST(ChildProcess, IsMissedWhenItIsMissing) {
  EXPECT_THROW(runChild("/no/such/program", {}, "x"), std::system_error);
}

TEST(ReadByAssimp, ManyThreadsReadAtOnce) {
  std::vector<std::thread> threads;
  std::vector<size_t> triangles(8, 0);
  for (size_t k = 0; k < triangles.size(); ++k)
    threads.emplace_back([&triangles, k] {
      triangles[k] = readByAssimp(obj(shapes::kBox), "part.obj", "obj").mesh.triangles.size();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(triangles, testing::Each(12u));
}

TEST(ReadByAssimp, LibrariesOfMaterialsDoNotCount) {
  const std::string with = "mtllib a.mtl\nusemtl a\n" + obj(shapes::kBox) + "  mtllib b.mtl\nmtllib";
  const ReadMesh read = readByAssimp(with, "part.obj", "obj");
  EXPECT_EQ(read.mesh.triangles,
            readByAssimp("usemtl a\n" + obj(shapes::kBox), "part.obj", "obj").mesh.triangles);
  EXPECT_EQ(read.metres_per_unit, 0);
}

TEST(ReadByAssimp, SaysWhatEndedTheReader) {
  const AssimpLimits limits;
  const auto of_signal = [&](int signal) { return assimpProblem(signal, limits); };  // as waitpid() tells it
  EXPECT_THAT(of_signal(SIGSEGV), AllOf(HasSubstr("crashes"), HasSubstr("export it as STL")));
  EXPECT_THAT(of_signal(SIGABRT), HasSubstr("crashes"));
  EXPECT_THAT(of_signal(SIGXCPU), AllOf(HasSubstr("longer than 60 s"), HasSubstr("export it as STL")));
  EXPECT_THAT(of_signal(SIGALRM), HasSubstr("longer than 60 s"));
  EXPECT_THAT(of_signal(SIGKILL), AllOf(HasSubstr("memory"), HasSubstr("export it as STL")));
  EXPECT_THAT(of_signal(SIGINT), HasSubstr("interrupted"));
}

TEST(ReadByAssimp, TheReaderMayTakeSoMuchMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer does not work with less addresses";
#endif
  AssimpLimits limits;
  limits.megabytes = 1;
  EXPECT_THAT(refusal([&] { readByAssimp(obj(shapes::kBox), "folder/part.obj", "obj", limits); }),
              AllOf(HasSubstr("folder/part.obj"), HasSubstr("memory"), HasSubstr("1 MB")));
}

TEST(ReadByAssimp, TheReaderMayTakeSoMuchTime) {
  std::string endless = dae(shapes::kBox, "");
  endless.insert(endless.find("<p>") + 3, "x ");
  const ChildResult child = runChild(ASSIMP_READER_PROGRAM, {"dae", "1", "4096"}, endless);
  // Releases of assimp that do not run for ever refuse it.
  EXPECT_TRUE(signalOf(child) == SIGXCPU || WIFEXITED(child.status)) << child.status;
}

}  // namespace
}  // namespace monocular_eye_hand
