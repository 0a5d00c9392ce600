#include "engine/formats/par_file.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

Result<ParFile> Read(const std::string& text) { return ReadPar(text, "a.par"); }

TEST(ParFileTest, S27_KeyedForm) {
  const ParFile par = Read(
                          "Taiwan, pictures 9 and 10\nparameters\nmaxlevel 10\nepsilon 0.1\n"
                          "fixvl = 0.4\nseed: 71\n\nH-Fdim .3  # rough\nsigma 0.5\n")
                          .value();
  EXPECT_EQ(par.max_level, 10);
  EXPECT_EQ(par.epsilon, .1);
  EXPECT_EQ(par.fixvl, .4);
  EXPECT_EQ(par.seed, 71);
  EXPECT_EQ(par.H, .3);
  EXPECT_EQ(par.sigma, .5);
  EXPECT_FALSE(par.scale);
}

TEST(ParFileTest, S27_OlderPositionalForm) {
  for (const char* text :
       {"100\n7.5\n71\n0.7\n1\n", "100 7.5 71 0.7 1", "\n100 7.5\n71 .7 # H\n1"}) {
    const ParFile par = Read(text).value();
    EXPECT_EQ(par.scale, 100);
    EXPECT_EQ(par.eye_distance, 7.5);
    EXPECT_EQ(par.seed, 71);
    EXPECT_EQ(par.H, .7);
    EXPECT_EQ(par.sigma, 1);
    EXPECT_FALSE(par.epsilon);
  }
}

TEST(ParFileTest, S27_EveryFaultIsNamedWithItsPlace) {
  struct Case {
    const char* text;
    const char* place;
    const char* words;
  };
  const Case cases[] = {
      {"", "a.par", "empty"},
      {"hello\n", "a.par", "no line `parameters`"},
      {"parameters\n", "a.par:1", "no parameter follows"},
      {"parameters\nH-Fdim 1.5\n", "a.par:2:8", "H-Fdim must be from 0 to 1, not '1.5'"},
      {"parameters\nH-Fdim -0.1\n", "a.par:2:8", "from 0 to 1"},
      {"parameters\nH-Fdim nan\n", "a.par:2:8", "not finite"},
      {"parameters\nepsilon 0\n", "a.par:2:9", "greater than 0"},
      {"parameters\nepsilon -1\n", "a.par:2:9", "greater than 0"},
      {"parameters\nepsilon 1e308\n", "a.par:2:9", "too large"},
      {"parameters\nmaxlevel 1000\n", "a.par:2:10", "from 0 to 40"},
      {"parameters\nmaxlevel 2.5\n", "a.par:2:10", "whole number"},
      {"parameters\nseed -1\n", "a.par:2:6", "whole number from 0"},
      {"parameters\nsigma\n", "a.par:2:1", "takes one number"},
      {"parameters\nsigma 1 2\n", "a.par:2:1", "takes one number"},
      {"parameters\nsigma one\n", "a.par:2:7", "'one' is not a number"},
      {"parameters\nsigma 1\nsigma 2\n", "a.par:3:7", "given twice"},
      {"parameters\nsgima 1\n", "a.par:2:1", "'sgima' is no parameter; known are"},
      {"100\n7.5\n71\n1.7\n1\n", "a.par:4:1", "H-Fdim must be from 0 to 1"},
      {"100\n7.5\n71\n.7\n", "a.par:4", "only 4 of the five"},
      {"100\n7.5\n71\n.7\n1\n2\n", "a.par:6:1", "more than the five"},
      {"100\nx\n", "a.par:2:1", "'x' is not a number"},
      {"0 7.5 71 .7 1\n", "a.par:1:1", "scale must be greater than 0"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    ExpectError(Read(c.text), c.place, c.words);
  }
  ExpectError(Read(std::string("\0\1\2", 3)), "a.par", "binary");
  ExpectError(Read(std::string(2 << 20, ' ')), "a.par", "at most 1 MiB");
  ExpectError(Read("parameters\n" + std::string(70'000, 'x')), "a.par:2", "longer than 64 KiB");
}

bool Same(const ParFile& a, const ParFile& b) {
  return a.max_level == b.max_level && a.epsilon == b.epsilon && a.fixvl == b.fixvl &&
         a.scale == b.scale && a.eye_distance == b.eye_distance && a.seed == b.seed && a.H == b.H &&
         a.sigma == b.sigma;
}

RC_GTEST_PROP(ParFileTest, S27_WrittenParametersReadBack, ()) {
  const auto maybe = [](double lowest, double highest, bool whole) -> std::optional<double> {
    if (*rc::gen::arbitrary<bool>()) return std::nullopt;
    const double share = *rc::gen::inRange(1, 1'000'000) / 1e6;
    const double value = lowest + share * (highest - lowest);
    return whole ? static_cast<double>(static_cast<int64_t>(value)) : value;
  };
  ParFile par;
  par.max_level = maybe(0, 40, true);
  par.epsilon = maybe(0, 3, false);
  par.fixvl = maybe(0, 3, false);
  par.scale = maybe(0, 300, false);
  par.eye_distance = maybe(0, 300, false);
  par.seed = maybe(0, 1e15, true);
  par.H = maybe(0, 1, false);
  par.sigma = maybe(0, 3, false);
  RC_PRE(!Same(par, ParFile{}));
  RC_ASSERT(Same(Read(WritePar(par)).value(), par));
}

TEST(ParFileTest, S27_BothFormsAreWritten) {
  EXPECT_EQ(WritePar(Read("100 7.5 71 0.7 1").value()), "100\n7.5\n71\n0.7\n1\n");
  EXPECT_EQ(WritePar(Read("parameters\nsigma 1\nmaxlevel 3").value()),
            "parameters\nmaxlevel 3\nsigma 1\n");
}

}  // namespace
}  // namespace fjord
