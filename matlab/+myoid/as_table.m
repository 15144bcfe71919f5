function columns = as_table(columns)
  % AS_TABLE  A struct of columns as a table; in Octave, which has no tables, the struct itself.
  if ~exist('OCTAVE_VERSION', 'builtin')
    columns = struct2table(columns);
  end
end
