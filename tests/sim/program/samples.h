// One sample file for each reader, for tests and as the start of the fuzzing corpus.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/program/import.h"

namespace dresslife::tests {

/// Returns one program per language. It contains most of the instructions that its reader supports.
inline const std::vector<std::pair<sim::Language, std::string>>& samples() {
  using sim::Language;
  static const std::vector<std::pair<Language, std::string>> list{
      {Language::rapid,
       "MODULE M\nRECORD r num a; pos b; ENDRECORD\nPERS tooldata "
       "t:=[TRUE,[[0,0,1],[1,0,0,0]],[1,[0,0,0],[1,0,0,0],0,0,0]];\nCONST robtarget "
       "p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nVAR num a{3}:=[1,2,3];\nPROC "
       "main()\nFOR i FROM 1 TO 3 DO\nMoveL "
       "Offs(p,a{i},0,-i)\\T:=2,v100,z10,t\\WObj:=wobj0;\nENDFOR\nIF di1=1 THEN\nMoveJ "
       "p,v5,fine,tool0;\nELSEIF FALSE THEN\nsub 1\\x:=2;\nENDIF\nTEST "
       "a{1}\nCASE 1,2:\nWaitTime 1;\nDEFAULT:\nExit;\nENDTEST\nMoveC "
       "p,RelTool(p,1,2,3\\Rx:=4),v50,z1,tool0;\nENDPROC\nPROC sub(num y\\num "
       "x)\na{2}:=a{2}+y DIV 2;\nWHILE a{2}<9 DO\na{2}:=a{2}*2;\nENDWHILE\nENDPROC\nFUNC num f(num "
       "z)\nRETURN -z;\nENDFUNC\nENDMODULE\n"},
      {Language::krl,
       "&ACCESS RVP\nDEF m()\nDECL E6POS P[2]\nSIGNAL g $OUT[7]\nINT i\nP[1]={X 1,Y 2,Z 3,A 0,B 0,C 0,S 2,T "
       "35}\n$VEL.CP=0.5\nBAS(#VEL_PTP,50)\nPTP P[1] C_PTP\nFOR i=1 TO 3 STEP "
       "1\nLIN {X i} C_DIS\nENDFOR\nCIRC {X 1,Y 2,Z 4},P[1]\nSPLINE WITH $VEL.CP=1\nSPL P[1]\nENDSPLINE\nIF "
       "$IN[1]==TRUE THEN\nPTP XHOME\nELSE\nHALT\nENDIF\nCONTINUE\ng=TRUE\nout=FALSE\nWAIT SEC 1\nSWITCH i\nCASE "
       "1,2\nf(i)\nDEFAULT\nENDSWITCH\nLOOP\nEXIT\nENDLOOP\n$BASE={X 1,Y 0,Z 0,A 0,B 0,C 0}:{X 0,Y 1,Z 0,A "
       "9,B 8,C 7}\nEND\nDEF f(x:IN)\nREPEAT\nx=x+1\nUNTIL x>4\nEND\n"},
      {Language::fanuc,
       "/PROG M\n/MN\n 1:J P[1] 100% CNT100 ;\n 2: R[1]=1+2*3 ;\n 3: FOR R[2]=1 TO 3 ;\n 4:L P[2] R[1]mm/sec "
       "FINE Offset,PR[1] ;\n 5: ENDFOR ;\n 6: IF (R[1]>3 AND !DI[1]=ON) THEN "
       ";\n 7: WAIT 1.0(sec) ;\n 8: ELSE ;\n 9: ENDIF ;\n10: SELECT R[1]=1,JMP LBL[1] ;\n11: ELSE,CALL M "
       ";\n12: LBL[1:x] ;\n13:C P[2]\n   : P[2] 10cm/min CNT50 ;\n14: PR[1,3]=5 ;\n15: JMP "
       "LBL[1] ;\n/POS\nP[1]{\n GP1:\n UF : 0, UT : 0,\n J1= 1 deg, J2= 2 deg, J3= 3 deg, J4= 4 deg, J5= 5 "
       "deg, J6= 6 deg\n};\nP[2]{\n GP1:\n UF : 0, UT : 0, CONFIG : 'N U T, 0, 0, 0',\n X = 1 mm, "
       "Y = 2 mm, Z = 3 mm,\n W = 4 deg, P = 5 deg, R = 6 deg\n};\n/END\n"},
      {Language::inform,
       "/JOB\n//NAME M\n//POS\n///NPOS 3,0,1,1,0,0\n///TOOL 1\n///POSTYPE PULSE\n///PULSE\nC00000=1,2,3,4,5,6\n"
       "EC00000=7\n///USER 1\n///POSTYPE USER\n///RECTAN\n///RCONF 1,0,0,0,0,0,0,0\nC00001=1,2,3,180,0,0\n"
       "C00002=1,3,4,180,0,0\nP00001=0,0,9,0,0,0\n//INST\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\nSPEED VJ=9.0 V=9.0\n"
       "MOVJ C00000 VJ=5.0 PL=1 +MOVJ EC00000 VJ=1\n*L\nSET B000 EXPRESS B000 + 1\nSET P002 P001\nADD P002 P001\n"
       "SETE P002 (3) 500\nSFTON P002 UF#(1)\nMOVL C00001 V=I001 CR=2 //x\nSFTOF\nMOVC C00001\nMOVC C00002 FPT\n"
       "MOVC P001\nIMOV P001 V=1 TF\nIFTHENEXP B000>3 ANDEXP IN#(2)=ON\nTIMER T=0.5\nELSE\nCALL JOB:M ARGF1 IF "
       "B[0]=9\nENDIF\nFOR I000 START= 1 TO 3\nWHILE I000<2\nINC I000\nENDWHILE\nNEXT I000\nSWITCH B000 CASE 1\n"
       "PAUSE\nDEFAULT\nDOUT OT#(1) ON\nENDSWITCH\nMFRAME UF#(1) P001 P002 P003\nSETTOOL TL#(1) P001\nJUMP *L IF "
       "B000<3\nEND\n//TOOL 1\n0,0,9,0,0,0\n//UFRAME 1\n////BUSER 1,2,3,4,5,6\n//VAR\n///B\n1,2\n"},
      {Language::urscript,
       "def m():\n  set_tcp(p[0,0,.1,0,0,0])\n  global w_p=p[.4,-.2,.3,0,3.14,0]\n  global w_q=[0,-1.5,1.5,-1.5,-1.5,0]\n"
       "  thread t():\n    while True:\n      n = n + 1\n      sync()\n    end\n  end\n  h = run t()\n  def f(a, b=2):\n"
       "    local c = a[0] + b % 2\n    if not c != 1 and True:\n      return c\n    elif c > 2:\n      a[1] = 3\n    else:\n"
       "      pass\n    end\n    return -c\n  end\n  i = 0\n  while i < 3:\n    $ 3 \"W\"\n    movej(get_inverse_kin(w_p, "
       "qnear=w_q), a=1.4, v=1.05)\n    i = i + 1\n    if i == 2:\n      continue\n    end\n    "
       "movel(pose_trans(w_p,p[0,0,-.1,0,0,0]),v=.2,r=0.01)\n  end\n  movec(w_p, pose_add(w_p,p[.1,0,0,0,0,0]), "
       "a=1,\n    v=.1)\n  movej(w_q, t=2)\n  x = f(w_q)\n  sleep(0.5)\n  if get_standard_digital_in(0):\n    "
       "textmsg('a', x)\n    halt\n  end\n  servoj([0,0,0,0,0,0],t=.1)\n  movep(get_forward_kin(w_q))\nend\n"},
      {Language::joint_columns, "time, axis 1 deg, axis 2 deg\n0, 1, 2\n0.5, 1.5, 2.5\n# note\n1, 2, 3\n"},
      {Language::ros_trajectory,
       R"({"joint_names": ["joint_1", "joint_2"], "points": [{"positions": [0, 1], "time_from_start": {"sec": 0, "nanosec": 0}}, {"positions": [0.5, 1], "time_from_start": 1.5}]})"}};
  return list;
}

/// A URDF with five joints, four of them driven, a fixed link in the chain, a fixed base and a gripper that moves.
inline const std::string palletizer = R"(<?xml version="1.0"?>
<!-- a made-up palletizer -->
<robot name="palletizer">
  <link name="floor"/>
  <link name="base_link"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.4 0.5 0.2"/></geometry></collision></link>
  <link name="turret"/>
  <link name="lower_arm">
    <collision><origin xyz="0 0 0.5"/><geometry><cylinder length="1" radius="0.1"/></geometry></collision>
  </link>
  <link name="forearm"/>
  <link name="bracket"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="wrist"/>
  <link name="hand"/>
  <link name="tool0"/>
  <link name="finger"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <joint name="stand" type="fixed"><parent link="floor"/><child link="base_link"/><origin xyz="0 0 0.3"/></joint>
  <joint name="j1" type="continuous"><parent link="base_link"/><child link="turret"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 0 1"/><limit effort="0" velocity="2"/></joint>
  <joint name="j2" type="revolute"><parent link="turret"/><child link="lower_arm"/><origin xyz="0.2 0 0"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1.5" effort="0" velocity="1.5"/></joint>
  <joint name="j3" type="revolute"><parent link="lower_arm"/><child link="forearm"/><origin xyz="0 0 1"/>
    <axis xyz="0 1 0"/><limit lower="-0.5" upper="2" effort="0" velocity="1.5"/></joint>
  <joint name="rail" type="fixed"><parent link="forearm"/><child link="bracket"/>
    <origin xyz="0.3 0 0.1" rpy="0 0 1.5707963267948966"/></joint>
  <joint name="level" type="revolute"><parent link="bracket"/><child link="wrist"/><origin xyz="0 -0.7 -0.1"/>
    <axis xyz="1 0 0"/><limit lower="-3" upper="0.8" effort="0" velocity="9"/>
    <mimic joint="j2" multiplier="-1" offset="0.1"/></joint>
  <joint name="j4" type="revolute"><parent link="wrist"/><child link="hand"/><origin xyz="0 0 -0.1"/>
    <axis xyz="0 0 -1"/><limit lower="-6" upper="6" effort="0" velocity="6"/></joint>
  <joint name="flange" type="fixed"><parent link="hand"/><child link="tool0"/>
    <origin xyz="0 0 -0.05" rpy="3.141592653589793 0 0"/></joint>
  <joint name="grip" type="prismatic"><parent link="tool0"/><child link="finger"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.1" effort="0" velocity="1"/></joint>
</robot>
)";

}  // namespace dresslife::tests
