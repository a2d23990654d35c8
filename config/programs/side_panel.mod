MODULE side_panel
  ! Spot welding on a side panel, for an ABB IRB 6640 with a gun of 140 kg. Written for dresslife; no plant's program.
  ! Two rows of spots, eight on the sill and eight on the lower B pillar. Between the rows the gun is turned by 35 deg
  ! about axis 4 and by 40 deg about axis 6.

  PERS tooldata gun:=[TRUE,[[180,0,550],[1,0,0,0]],[140,[120,0,320],[1,0,0,0],9,12,7]];
  PERS wobjdata panel:=[FALSE,TRUE,"",[[1600,-400,500],[0.7071068,0,0,0.7071068]],[[0,0,0],[1,0,0,0]]];
  CONST jointtarget home:=[[0,-10,10,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST speeddata to_panel:=[1500,300,5000,1000];

  CONST robtarget ap_sill:=[[1893.17,-78.66,35.30],[0.2648630,0.2827270,0.9214859,-0.0278697],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p101:=[[1804.91,69.53,-241.87],[0.1706843,0.2897467,0.9400796,0.0562504],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p102:=[[1787.84,61.57,-245.20],[0.1730828,0.2921329,0.9371002,0.0808940],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p103:=[[1769.52,49.98,-249.99],[0.1772514,0.2926906,0.9340152,0.1026146],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p104:=[[1749.12,38.33,-252.08],[0.1830284,0.2917169,0.9307935,0.1225774],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p105:=[[1730.16,24.86,-254.45],[0.1899309,0.2882529,0.9280785,0.1396670],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p106:=[[1707.34,6.00,-253.20],[0.1989338,0.2843932,0.9252252,0.1533109],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p107:=[[1681.84,-12.86,-254.30],[0.2079913,0.2796688,0.9225725,0.1654841],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p108:=[[1653.93,-35.48,-253.04],[0.2179569,0.2745462,0.9203711,0.1733099],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget ap_pillar:=[[1487.43,-394.77,603.92],[0.5752058,0.1671147,0.7996691,-0.0417172],[0,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p201:=[[1510.69,-317.74,345.20],[0.5594127,0.1809413,0.8068573,0.0574374],[0,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p202:=[[1516.54,-288.64,407.00],[0.5796723,0.1524233,0.7981991,0.0602121],[0,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p203:=[[1521.06,-262.40,474.98],[0.6004750,0.1236283,0.7878147,0.0591084],[0,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p204:=[[1523.69,-242.26,545.45],[0.6201257,0.0943313,0.7769650,0.0535827],[0,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p205:=[[1525.09,-226.09,623.91],[0.6397389,0.0648091,0.7646401,0.0431211],[0,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p206:=[[1524.30,-212.32,699.61],[0.6572566,0.0360675,0.7522095,0.0298964],[0,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p207:=[[1522.11,-201.53,779.32],[0.6735036,0.0074769,0.7390356,0.0127794],[0,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p208:=[[1515.54,-194.61,867.36],[0.6889430,-0.0211362,0.7244389,-0.0099500],[0,1,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget lv_sill:=[[1711.57,-197.62,-3.48],[0.2879443,0.2669652,0.9168186,0.0725347],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget lv_pillar:=[[1489.77,-198.32,1107.94],[0.6860217,-0.0384740,0.7193868,-0.1018657],[0,1,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    AccSet 90,100;
    MoveAbsJ home\NoEOffs,v2000,fine,gun;
    WHILE TRUE DO
      WaitDI di_panel_clamped,1;
      sill;
      pillar;
      PulseDO do_panel_done;
      MoveAbsJ home\NoEOffs,v2000,fine,gun;
    ENDWHILE
  ENDPROC

  PROC sill()
    MoveJ ap_sill,to_panel,z50,gun\WObj:=panel;
    SpotL p101,v500,gun_1,spot_sill,gun\WObj:=panel;
    SpotL p102,v800,gun_1,spot_sill,gun\WObj:=panel;
    SpotL p103,v800,gun_1,spot_sill,gun\WObj:=panel;
    SpotL p104,v800,gun_1,spot_sill,gun\WObj:=panel;
    SpotL p105,v800,gun_1,spot_sill,gun\WObj:=panel;
    SpotL p106,v800,gun_1,spot_sill,gun\WObj:=panel;
    SpotL p107,v800,gun_1,spot_sill,gun\WObj:=panel;
    SpotL p108,v800,gun_1,spot_sill,gun\WObj:=panel;
    MoveL lv_sill,v1000,z50,gun\WObj:=panel;
  ENDPROC

  PROC pillar()
    MoveJ ap_pillar,to_panel,z100,gun\WObj:=panel;
    SpotL p201,v500,gun_1,spot_pillar,gun\WObj:=panel;
    SpotL p202,v800,gun_1,spot_pillar,gun\WObj:=panel;
    SpotL p203,v800,gun_1,spot_pillar,gun\WObj:=panel;
    SpotL p204,v800,gun_1,spot_pillar,gun\WObj:=panel;
    SpotL p205,v800,gun_1,spot_pillar,gun\WObj:=panel;
    SpotL p206,v800,gun_1,spot_pillar,gun\WObj:=panel;
    SpotL p207,v800,gun_1,spot_pillar,gun\WObj:=panel;
    SpotL p208,v800,gun_1,spot_pillar,gun\WObj:=panel;
    MoveL lv_pillar,v1000,z100,gun\WObj:=panel;
  ENDPROC
ENDMODULE
