#include "board/bench/reconcile/job_list.h"

#include <string>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

const std::string kHeader = "job,leg,row,column,time_utc\n";

TEST(JobList, ReadsJobsDoneAndToBeDone) {
  std::vector<Job> jobs;
  drivers::Messages messages;

  ASSERT_TRUE(read_jobs(kHeader + "plug,hot,12,34,2026-12-01T03:04:05Z\nplug,cold,12,34,\n",
                        "jobs.csv", jobs, messages));

  ASSERT_EQ(jobs.size(), 2U);
  EXPECT_EQ(jobs[0].kind, "plug");
  EXPECT_EQ(jobs[0].leg, Leg::kHot);
  EXPECT_EQ(jobs[0].tube, (core::TubeAddress{12, 34}));
  EXPECT_TRUE(jobs[0].done_at);
  EXPECT_EQ(jobs[1].leg, Leg::kCold);
  EXPECT_FALSE(jobs[1].done_at);
  EXPECT_EQ(jobs[1].line, 3);
}

TEST(JobList, SaysOfEachBadRowWhatAndWhere) {
  std::vector<Job> jobs;
  drivers::Messages messages;

  EXPECT_FALSE(read_jobs(kHeader + ",hot,1,2,\nplug,warm,1,2,\nplug,hot,1,x,\nplug,hot,1,2,now\n",
                         "jobs.csv", jobs, messages));

  ASSERT_EQ(messages.size(), 4U);
  EXPECT_EQ(messages[0], "jobs.csv:2: job: '', expected a word such as plug");
  EXPECT_EQ(messages[1], "jobs.csv:3: leg: 'warm', expected hot or cold");
  EXPECT_EQ(messages[2], "jobs.csv:4: row, column: '1,x', expected two whole numbers");
  EXPECT_EQ(messages[3].find("jobs.csv:5: time_utc: 'now', expected UTC as"), 0U) << messages[3];
}

TEST(JobList, RefusesAFileWithoutJobs) {
  std::vector<Job> jobs;
  drivers::Messages messages;
  EXPECT_FALSE(read_jobs(kHeader, "jobs.csv", jobs, messages));
  EXPECT_EQ(messages, drivers::Messages{"jobs.csv: holds no job, expected a row for each"});
}

}  // namespace
}  // namespace tubesight::board
