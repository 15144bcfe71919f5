function t = table(columns)
  % A stand-in for MATLAB's class where there is none (Octave): a struct of columns by name.
  t = class(struct('columns', columns), 'table');
end
