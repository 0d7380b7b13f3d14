// `tubesight look` on pictures that nobody told it anything about.

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/files/picture_reader.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/csv_rows.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using support::TemporaryFolder;

const std::string kSquareStill = TUBESIGHT_TEST_DATA_DIR "/stills/square_flush/still-0-0.png";
const std::string kTriangularStill = TUBESIGHT_TEST_DATA_DIR "/stills/triangular/still-0-0.png";

TEST(Look, TellsASquareSheetFromATriangularOne) {
  const TemporaryFolder folder;

  const ProgramRun run = run_tubesight(folder, {"look", kSquareStill, kTriangularStill});

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find(kSquareStill + ": a square lattice of dark elements: "), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find(kTriangularStill + ": a triangular lattice of dark elements: "),
            std::string::npos)
      << run.out;
}

TEST(Look, WritesARowForEachTubeEndInTheLatticesOrder) {
  const TemporaryFolder folder;

  const ProgramRun run =
      run_tubesight(folder, {"look", kSquareStill, "--csv", "l.csv", "--overlay", "o.png"});

  ASSERT_EQ(run.status, 0) << run.err;
  const std::string text = folder.read("l.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "image,row,column,u_px,v_px,diameter_px");
  // Tube-ends at these places of the picture (start9.txt names them by their addresses): next to
  // each other in a row, in a column, or across.
  const std::vector<Row> rows = read_rows(text);
  const auto at = [&](double u_px, double v_px) {
    for (const Row& row : rows) {
      if (std::hypot(number(row, "u_px") - u_px, number(row, "v_px") - v_px) < 15.0) {
        return row;
      }
    }
    ADD_FAILURE() << "nothing at " << u_px << ", " << v_px;
    return rows[0];
  };
  const auto a = at(304.0, 240.0);
  const auto b = at(373.0, 192.0);
  const auto c = at(310.0, 129.0);
  const double row_1 = number(b, "row") - number(a, "row");
  const double column_1 = number(b, "column") - number(a, "column");
  const double row_2 = number(c, "row") - number(a, "row");
  const double column_2 = number(c, "column") - number(a, "column");
  EXPECT_EQ(std::abs(row_1) + std::abs(column_1), 1.0);  // (7, 41) and (7, 42)
  EXPECT_EQ(std::abs(row_1 * column_2 - column_1 * row_2), 1.0);
  EXPECT_EQ(a.at("image"), kSquareStill);
  drivers::GreyPicture overlay;
  std::string message;
  ASSERT_TRUE(drivers::read_grey_picture(folder.path("o.png"), overlay, message).has_value());
  EXPECT_EQ(overlay.width_px, 635);
}

TEST(Look, TakesTheFirstFrameOfARecording) {
  const TemporaryFolder folder;

  const ProgramRun run = run_tubesight(
      folder, {"look", TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/recording.y4m.xz"});

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find(" frame 0: a square lattice"), std::string::npos) << run.out;
}

TEST(Look, SaysWhichPictureShowsNoneAndWritesTheOthers) {
  const TemporaryFolder folder;
  folder.write("grey.pgm", "P5\n64 64\n255\n" + std::string(64UL * 64UL, '\x60'));

  const ProgramRun run =
      run_tubesight(folder, {"look", "grey.pgm", kSquareStill, "--csv", "l.csv"});

  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err, "grey.pgm: no lattice found: no contrast in the picture\n");
  EXPECT_NE(folder.read("l.csv").find("\n" + kSquareStill + ",0,"), std::string::npos);

  const ProgramRun none = run_tubesight(folder, {"look", "grey.pgm", "--csv", "none.csv"});
  EXPECT_EQ(none.status, 1);
  EXPECT_FALSE(std::filesystem::exists(folder.path("none.csv")));
}

TEST(Look, SaysWhatIsWrongWithItsArguments) {
  const TemporaryFolder folder;
  const auto expect_wrong = [&](std::vector<std::string> arguments, const std::string& message) {
    arguments.insert(arguments.begin(), "look");
    const ProgramRun run = run_tubesight(folder, arguments);
    EXPECT_EQ(run.status, 2) << message;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  };

  expect_wrong({}, "PICTURE is missing");
  expect_wrong({"absent.png"}, "absent.png: cannot be read: No such file or directory");
  expect_wrong({kSquareStill, kSquareStill, "--overlay", "o.png"},
               "--overlay: one picture for 2, expected one PICTURE");
  expect_wrong({kSquareStill, "--csv", "x", "--overlay", "x"}, "--overlay: 'x' is also --csv");
  expect_wrong({kSquareStill, "--csv", kSquareStill}, "is also a picture");
  EXPECT_FALSE(std::filesystem::exists(folder.path("o.png")));
}

TEST(Look, SaysThatTheDiskIsFull) {
  const TemporaryFolder folder;

  const ProgramRun run = run_tubesight(folder, {"look", kSquareStill, "--csv", "/dev/full"});

  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err, "/dev/full: cannot be written: No space left on device\n");
}

}  // namespace
}  // namespace tubesight::tests
