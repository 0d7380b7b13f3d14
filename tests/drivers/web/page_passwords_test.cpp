#include "drivers/web/page_passwords.h"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

class PasswordFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path() const { return folder_.path("passwords"); }

 private:
  support::TemporaryFolder folder_;
};

TEST_F(PasswordFile, IsReadAsItWasWritten) {
  PagePasswords written;
  ASSERT_TRUE(written.set(PageRole::kViewer, "look but do not touch"));
  ASSERT_TRUE(written.save(path()));
  PagePasswords read;
  ASSERT_TRUE(read.load(path()));
  EXPECT_TRUE(read.is_right(PageRole::kViewer, "look but do not touch"));
  EXPECT_FALSE(read.is_right(PageRole::kViewer, "look but do not touch!"));
  EXPECT_FALSE(read.is_right(PageRole::kEngineer, "look but do not touch"));
}

TEST_F(PasswordFile, IsItsOwnersAloneAndHoldsNoPassword) {
  PagePasswords written;
  ASSERT_TRUE(written.set(PageRole::kOperator, "correct horse"));
  ASSERT_TRUE(written.save(path()));
  struct stat status {};
  ASSERT_EQ(stat(path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  std::ifstream file(path());
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(text.find("correct"), std::string::npos);
  EXPECT_NE(text.find("\noperator $7$"), std::string::npos);
}

TEST_F(PasswordFile, IsRefusedWithALineThatIsNone) {
  for (const char* const line : {"operator secret", "root $7$CU..../x$y", "operator"}) {
    std::ofstream(path()) << "# words\n" << line << "\n";
    PagePasswords passwords;
    EXPECT_FALSE(passwords.load(path())) << line;
    EXPECT_TRUE(passwords.empty());
    EXPECT_NE(passwords.message().find(":2:"), std::string::npos) << passwords.message();
  }
}

TEST(PagePasswords, AreLongEnough) {
  PagePasswords passwords;
  EXPECT_FALSE(passwords.set(PageRole::kViewer, "short"));
  EXPECT_FALSE(passwords.set(PageRole::kViewer, std::string(201, 'x')));
  EXPECT_TRUE(passwords.empty());
}

TEST(PagePasswords, ThatAreNotThereAreNeverRight) {
  const PagePasswords passwords;
  EXPECT_FALSE(passwords.is_right(PageRole::kEngineer, ""));
  EXPECT_FALSE(passwords.is_right(PageRole::kEngineer, "*"));
}

}  // namespace
}  // namespace tubesight::drivers
