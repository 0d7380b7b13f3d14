#include "drivers/web/page_sessions.h"

#include <vector>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

TEST(PageSessions, HaveSecretsThatNobodyGuesses) {
  PageSessions sessions;
  const std::string one = sessions.open(PageRole::kViewer, seconds(0));
  const std::string other = sessions.open(PageRole::kViewer, seconds(0));
  EXPECT_EQ(one.size(), 64U);
  EXPECT_NE(one, other);
  EXPECT_NE(sessions.find(one, seconds(0))->token, sessions.find(other, seconds(0))->token);
  EXPECT_EQ(sessions.find("", seconds(0)), nullptr);
  EXPECT_EQ(sessions.find(std::string(64, '0'), seconds(0)), nullptr);
}

TEST(PageSessions, EndWhenNobodyAsks) {
  PageSessions sessions;
  const std::string cookie = sessions.open(PageRole::kOperator, seconds(0));
  EXPECT_NE(sessions.find(cookie, PageSessions::kIdle), nullptr);
  EXPECT_EQ(sessions.find(cookie, 2 * PageSessions::kIdle + seconds(1)), nullptr);
}

TEST(PageSessions, EndAfterTheLongestTimeHoweverOftenOneAsks) {
  PageSessions sessions;
  const std::string cookie = sessions.open(PageRole::kViewer, seconds(0));
  for (PageSessions::Time now{0}; now <= PageSessions::kLongest; now += minutes(20)) {
    ASSERT_NE(sessions.find(cookie, now), nullptr);
  }
  EXPECT_EQ(sessions.find(cookie, PageSessions::kLongest + seconds(1)), nullptr);
}

TEST(PageSessions, ChangeTheirSecretsWithTheRole) {
  PageSessions sessions;
  const std::string before = sessions.open(PageRole::kNone, seconds(0));
  const std::string after = sessions.renew(before, PageRole::kEngineer, seconds(1));
  EXPECT_EQ(sessions.find(before, seconds(1)), nullptr);
  ASSERT_NE(sessions.find(after, seconds(1)), nullptr);
  EXPECT_EQ(sessions.find(after, seconds(1))->role, PageRole::kEngineer);
  EXPECT_EQ(sessions.renew(before, PageRole::kEngineer, seconds(1)), "");
}

TEST(PageSessions, MakeRoomByThoseWhoNeverLoggedIn) {
  PageSessions sessions;
  const std::string logged_in = sessions.open(PageRole::kOperator, seconds(0));
  for (std::size_t i = 0; i < 3 * PageSessions::kMost; ++i) {
    EXPECT_NE(sessions.open(PageRole::kNone, seconds(1)), "");
  }
  EXPECT_EQ(sessions.count(), PageSessions::kMost);
  EXPECT_NE(sessions.find(logged_in, seconds(1)), nullptr);
}

TEST(PageSessions, AreFullWhenAllAreAtWork) {
  PageSessions sessions;
  for (std::size_t i = 0; i < PageSessions::kMost; ++i) {
    ASSERT_NE(sessions.open(PageRole::kViewer, seconds(0)), "");
  }
  EXPECT_EQ(sessions.open(PageRole::kNone, seconds(1)), "");
  EXPECT_NE(sessions.open(PageRole::kNone, seconds(62)), "");
}

TEST(PageSessions, LetOneOperate) {
  PageSessions sessions;
  const std::string one = sessions.open(PageRole::kOperator, seconds(0));
  const std::string other = sessions.open(PageRole::kOperator, seconds(0));
  EXPECT_TRUE(sessions.take_over(one, "Ann", false, seconds(0)));
  EXPECT_FALSE(sessions.take_over(other, "Bob", false, seconds(1)));
  EXPECT_TRUE(sessions.operates(one));
  EXPECT_TRUE(sessions.take_over(other, "Bob", true, seconds(2)));
  EXPECT_FALSE(sessions.operates(one));
  EXPECT_EQ(sessions.who_operates(seconds(2)).name, "Bob");
  sessions.hand_back(one);
  EXPECT_TRUE(sessions.operates(other));
  sessions.hand_back(other);
  EXPECT_TRUE(sessions.take_over(one, "Ann", false, seconds(3)));
}

TEST(PageSessions, LetTheNextOneOperateWhenTheOneBeforeIsAway) {
  PageSessions sessions;
  const std::string one = sessions.open(PageRole::kOperator, seconds(0));
  const std::string other = sessions.open(PageRole::kOperator, seconds(0));
  EXPECT_TRUE(sessions.take_over(one, "Ann", false, seconds(0)));
  EXPECT_FALSE(sessions.take_over(other, "Bob", false, seconds(59)));
  EXPECT_TRUE(sessions.take_over(other, "Bob", false, seconds(61)));
}

TEST(PageSessions, ThatEndOperateNoMore) {
  PageSessions sessions;
  const std::string one = sessions.open(PageRole::kOperator, seconds(0));
  EXPECT_TRUE(sessions.take_over(one, "Ann", false, seconds(0)));
  sessions.close(one);
  EXPECT_TRUE(sessions.who_operates(seconds(1)).session.empty());
  EXPECT_FALSE(sessions.operates(""));
}

TEST(PageRoles, HaveWords) {
  EXPECT_EQ(role_of("operator"), PageRole::kOperator);
  EXPECT_EQ(role_of("none"), std::nullopt);
  EXPECT_EQ(role_of("root"), std::nullopt);
  EXPECT_EQ(name_of(PageRole::kEngineer), "engineer");
}

}  // namespace
}  // namespace tubesight::drivers
