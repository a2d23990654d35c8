// Remedies of the readers in the words of a job's YAML.
#include "sim/program/job_words.h"

#include "tests/catch.h"

namespace dresslife::sim {

TEST_CASE("remedies name the keys of a job where a program stands in a job") {
  struct Pair {
    const char *option, *key;
  };
  for (
      const Pair& one :
      {Pair{"give --value 'di1=...' (motion.values)", "give motion.values: [{name: di1, value: VALUE}]"},
       {"give --value 'di1=...' --value 'R[5]=...'",
        "give motion.values: [{name: di1, value: VALUE}, {name: 'R[5]', value: VALUE}]"},
       {"or give --value joints=NAME,NAME,... in the order of the robot's axes",
        "or give motion.values: [{name: joints, value: 'NAME,NAME,...'}] in the order of the robot's axes"},
       {"or give --value unit=deg or unit=rad", "or give motion.values: [{name: unit, value: deg}] or value: rad"},
       {"give --value 'speed_unit=\"cm/min\"'", "give motion.values: [{name: speed_unit, value: '\"cm/min\"'}]"},
       {"choose with --assume q.mod:5=then or =else (motion.assume in a job), or give --value 'di1=...' (motion.values)",
        "choose with motion.assume: [{line: 'q.mod:5', take: then}] or take: else, or give motion.values: [{name: di1, value: VALUE}]"},
       {"give the module that declares it too (--module, motion.modules), or --value 'other=...' (motion.values)",
        "give the module that declares it too (motion.modules: [{file: FILE}]), or motion.values: [{name: other, value: VALUE}]"},
       {"or its frame in --frames FILE.yaml (motion.tools in a job) with the name 'gun'",
        "or its frame in motion.tools with the name 'gun'"},
       {"name the routine that moves it with --routine, or give what it asks for with --value, --assume or --module",
        "name the routine that moves it with motion.routine, or give what it asks for with motion.values, motion.assume or "
        "motion.modules: [{file: FILE}]"},
       {"no option -- at all", "no option -- at all"}})
    CHECK(in_words_of_a_job(one.option) == one.key);
}

}  // namespace dresslife::sim
