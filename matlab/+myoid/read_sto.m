function data = read_sto(file)
  % READ_STO  Reads a .sto or .mot file.
  %   data = myoid.read_sto('results/lift/ik.mot')
  % data.names: channels; data.time: n x 1 [s]; data.values: n x channels, as the file holds them; data.in_degrees;
  % data.title. In MATLAB data.table is a table with the column time first.
  text = fileread(file);
  lines = strsplit(strrep(text, char(13), ''), char(10));
  head = find(strcmpi(strtrim(lines), 'endheader'), 1);
  if isempty(head)
    error('myoid:badInput', '%s: there is no line endheader; a .sto or .mot file has one', file);
  end
  data.title = strtrim(lines{1});
  data.in_degrees = any(strcmpi(regexprep(lines(1:head), '\s', ''), 'inDegrees=yes'));
  first = head + 1;
  while isempty(strtrim(lines{first}))
    first = first + 1;
  end
  columns = regexp(strtrim(lines{first}), '\t', 'split');
  if numel(columns) == 1
    columns = regexp(strtrim(lines{first}), '\s+', 'split');
  end
  columns = strtrim(columns);
  body = strjoin(lines(first + 1:end), char(10));
  numbers = sscanf(body, '%f');
  if mod(numel(numbers), numel(columns)) ~= 0
    error('myoid:badInput', '%s: found %d numbers, expected a multiple of the %d columns', file, numel(numbers), ...
          numel(columns));
  end
  numbers = reshape(numbers, numel(columns), [])';
  data.names = columns(2:end);
  data.time = numbers(:, 1);
  data.values = numbers(:, 2:end);
  if exist('array2table', 'file') == 2 && ~exist('OCTAVE_VERSION', 'builtin')
    data.table = array2table(numbers, 'VariableNames', matlab.lang.makeUniqueStrings( ...
                                                           matlab.lang.makeValidName(columns)));
  end
end
