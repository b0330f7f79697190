; X and Z are given or not
while iterations < 2
  if exists(param.X)
    G1 X{param.X + iterations} F100
  elif exists(param.Z)
    G1 Z{param.Z - iterations} F100
