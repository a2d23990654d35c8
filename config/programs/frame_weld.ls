/PROG  FRAME_WELD
/ATTR
COMMENT		= "written for dresslife";
DEFAULT_GROUP	= 1,*,*,*,*;
/MN
   1:  !Two seams on a frame, for a Fanuc M-20iA; no plant's program ;
   2:  UFRAME_NUM=0 ;
   3:  UTOOL_NUM=0 ;
   4:J P[1] 60% CNT100    ;
   5:  FOR R[1]=1 TO 2 ;
   6:J P[2] 50% CNT50    ;
   7:L P[3] 400mm/sec FINE    ;
   8:  Arc Start[1] ;
   9:L P[4] 60cm/min FINE    ;
  10:  Arc End[1] ;
  11:L P[5] 500mm/sec CNT80    ;
  12:  ENDFOR ;
  13:  WAIT    .50(sec) ;
  14:J P[1] 60% FINE    ;
/POS
P[1]{
   GP1:
	UF : 0, UT : 0,
	J1=     0.000 deg,	J2=     0.000 deg,	J3=     0.000 deg,
	J4=     0.000 deg,	J5=   -90.000 deg,	J6=     0.000 deg
};
P[2]{
   GP1:
	UF : 0, UT : 0,		CONFIG : 'N U T, 0, 0, 0',
	X =   950.000  mm,	Y =  -300.000  mm,	Z =   500.000  mm,
	W =   180.000 deg,	P =     0.000 deg,	R =     0.000 deg
};
P[3]{
   GP1:
	UF : 0, UT : 0,		CONFIG : 'N U T, 0, 0, 0',
	X =   950.000  mm,	Y =  -300.000  mm,	Z =   300.000  mm,
	W =   180.000 deg,	P =     0.000 deg,	R =     0.000 deg
};
P[4]{
   GP1:
	UF : 0, UT : 0,		CONFIG : 'N U T, 0, 0, 0',
	X =   950.000  mm,	Y =   300.000  mm,	Z =   300.000  mm,
	W =   180.000 deg,	P =   -10.000 deg,	R =     0.000 deg
};
P[5]{
   GP1:
	UF : 0, UT : 0,		CONFIG : 'N U T, 0, 0, 0',
	X =   950.000  mm,	Y =   300.000  mm,	Z =   500.000  mm,
	W =   180.000 deg,	P =     0.000 deg,	R =     0.000 deg
};
/END
