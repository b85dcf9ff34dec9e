#!/usr/bin/env bash
# Makes Gradescope's image: installs ROS and builds the suite.
# AUTOGRADER: another place of its folders;
# https://gradescope-autograders.readthedocs.io/en/latest/specs/
set -e
export TUTORIAL_WITHOUT="test view" TUTORIAL_WORKSPACE="${AUTOGRADER:-/autograder}/workspace"
cd "${AUTOGRADER:-/autograder}/source/suite"
./tutorial setup
