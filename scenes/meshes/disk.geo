// A disk of radius 1 with a collar of width delta, triangles of size h.
DefineConstant[ h = 0.1, delta = 0.3 ];

// sides of the outer polygon lie inside its circle: the collar is h wider than it need be
outer = 1 + delta + h;
Point(1) = {0, 0, 0, h};
For k In {0:3}
  Point(2 + k) = {Cos(k * Pi / 2), Sin(k * Pi / 2), 0, h};
  Point(6 + k) = {outer * Cos(k * Pi / 2), outer * Sin(k * Pi / 2), 0, h};
EndFor
For k In {0:3}
  Circle(1 + k) = {2 + k, 1, 2 + (k + 1) % 4};
  Circle(5 + k) = {6 + k, 1, 6 + (k + 1) % 4};
EndFor
Curve Loop(1) = {1:4};
Curve Loop(2) = {5:8};
Plane Surface(1) = {1};
Plane Surface(2) = {2, 1};
Physical Surface("omega") = {1};
Physical Surface("collar") = {2};
