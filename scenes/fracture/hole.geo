// A plate 2 x 1 with a round hole of radius 0.15 above its middle line, in triangles of size h.
DefineConstant[ h = 0.05 ];

r = 0.15;
Point(1) = {0, -.5, 0, h};
Point(2) = {2, -.5, 0, h};
Point(3) = {2, .5, 0, h};
Point(4) = {0, .5, 0, h};
Point(5) = {1, .2, 0, h};
For k In {0:3}
  Point(6 + k) = {1 + r * Cos(k * Pi / 2), .2 + r * Sin(k * Pi / 2), 0, h};
EndFor
For k In {0:3}
  Line(1 + k) = {1 + k, 1 + (k + 1) % 4};
  Circle(5 + k) = {6 + k, 5, 6 + (k + 1) % 4};
EndFor
Curve Loop(1) = {1:4};
Curve Loop(2) = {5:8};
Plane Surface(1) = {1, 2};
Physical Surface("omega") = {1};
